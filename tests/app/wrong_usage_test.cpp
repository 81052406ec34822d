// Wrong use of the command line: exit code 2 (5 where the output cannot be written), one message that
// names the option, and no file left behind.
#include <gtest/gtest.h>

#include "tests/app/floe_runner.h"
#include "tests/app/wrong_cases.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

class WrongUsage : public testing::TestWithParam<WrongCase> {};

TEST_P(WrongUsage, IsSaidAndLeavesNothing) {
  const TemporaryFolder folder;
  write_readable_event(folder.path() / "event.hits");
  write_bytes(folder.path() / "runs.hits", "FLASHER 63 20\nHIT 20 30 100.0 400.0 1.5 0.5 1.5 0.5\n");
  expect_said_and_nothing_left(folder.path(), GetParam());
}

const std::string cascade = "simulate --cascade 20,-40,-300,70,130,1 -o out.h5 ";
const std::string flasher = "simulate --flasher 63,20 -o out.h5 ";
const std::string point = "simulate --point 20,-40,-300 -o out.h5 ";

const WrongCase cases[] = {
    {"NoCommand", "", 2, "no command"},
    {"UnknownCommand", "simulat", 2, "did you mean simulate?"},
    {"UnknownOption", cascade + "--seeed 3", 2, "did you mean --seed?"},
    {"UnknownOptionBeforeMissingOne", "simulate --phtons 3", 2, "did you mean --photons?"},
    {"UnknownOptionWithoutNeighbour", "info --zzzzzzzz", 2, "unknown option --zzzzzzzz"},
    {"UnexpectedArgument", "info something", 2, "unexpected argument something"},
    {"OptionTwice", cascade + "--seed 1 --seed 2", 2, "--seed"},
    {"OptionWithoutValue", cascade + "--seed", 2, "--seed"},
    {"NoOutput", "simulate --cascade 20,-40,-300,70,130,1", 2, "--output"},
    {"NoSource", "simulate -o out.h5", 2,
     "exactly one of --flasher, --flashers, --cascade, --f2k, --point and --standard-candle"},
    {"TwoSources", cascade + "--flasher 63,20 --photons 1e6", 2, "exactly one of"},
    {"TwoKindsOfFlashers", flasher + "--photons 1e6 --flashers runs.toml", 2, "exactly one of"},
    {"CascadeOfFiveNumbers", "simulate --cascade 20,-40,-300,70,130 -o out.h5", 2, "expected 6 numbers"},
    {"CascadeWithLetter", "simulate --cascade 20,-4O,-300,70,130,1 -o out.h5", 2, "found \"-4O\""},
    {"CascadeWithNan", "simulate --cascade nan,-40,-300,70,130,1 -o out.h5", 2, "found \"nan\""},
    {"CascadeOfNoEnergy", "simulate --cascade 20,-40,-300,70,130,0 -o out.h5", 2, "energy [GeV]"},
    {"CascadeOfZenith181", "simulate --cascade 20,-40,-300,181,130,1 -o out.h5", 2, "zenith [deg]"},
    {"UnknownParticle", cascade + "--particle proton", 2, "proton"},
    {"FlasherWithoutPhotons", flasher, 2, "--flasher needs --photons"},
    {"FlasherOfThreeNumbers", "simulate --flasher 63,20,1 --photons 1e6 -o out.h5", 2, "STRING,DOM"},
    {"FlasherInWords", "simulate --flasher 63,twenty --photons 1e6 -o out.h5", 2, "found \"twenty\""},
    {"NoPhotons", flasher + "--photons 0", 2, "--photons"},
    {"NegativePhotons", flasher + "--photons -2e9", 2, "--photons"},
    {"InfinitePhotons", flasher + "--photons inf", 2, "--photons"},
    {"PhotonsWithRest", flasher + "--photons 2e9x", 2, "found \"2e9x\""},
    {"PhotonsBeyondDouble", flasher + "--photons 1e999", 2, "--photons"},
    {"PhotonsOfCascade", cascade + "--photons 1e6", 2, "--photons requires --flasher"},
    {"EmittedOfFlasher", flasher + "--photons 1e6 --emitted 1e9", 2, "--emitted requires --point"},
    {"PointWithoutPhotons", point, 2, "--point needs one of --photons N and --emitted N"},
    {"PointOfTwoBrightnesses", point + "--photons 1e6 --emitted 1e9", 2, "needs one of"},
    {"PointOfTwoNumbers", "simulate --point 1,2 --photons 1e6 -o out.h5", 2, "expected 3 numbers"},
    {"DirectionOfAnIsotropicPoint", point + "--photons 1e6 --elevation 30", 2, "needs --opening"},
    {"PointAndCandle", point + "--photons 1e6 --standard-candle 0,0,0", 2, "--point excludes"},
    {"BeamOfPoint", point + "--photons 1e6 --beam beam.txt", 3, "beam.txt"},
    {"NoPhotonsAtMost", cascade + "--most-photons 0", 2, "--most-photons"},
    {"WavelengthInMicrometres", flasher + "--photons 1e6 --wavelength 0.405", 2, "--wavelength"},
    {"BeamOfIsotropicFlasher", flasher + "--photons 1e6 --isotropic --width 5", 2, "--isotropic"},
    {"OversizeBelowOne", cascade + "--oversize 0.5", 2, "--oversize"},
    {"NoThreads", cascade + "--threads 0", 2, "--threads"},
    {"HalfAThread", cascade + "--threads 1.5", 2, "--threads"},
    {"NegativeSeed", cascade + "--seed -1", 2, "--seed"},
    {"UnknownEffect", cascade + "--without birefringense", 2, "did you mean 'birefringence'?"},
    {"EmptyEffect", cascade + "--without birefringence,", 2, "Known:"},
    {"UnknownIceVersion", "info --ice . --ice-version 11", 2, "version 11"},
    {"OutputOfAnotherKind", "simulate --cascade 20,-40,-300,70,130,1 -o out.root", 2, ".h5"},
    {"UnknownExportSuffix", "export event.hits -o out.root", 2, "out.root"},
    {"UnknownExportFormat", "export event.hits -o out.txt --format root", 2, "--format"},
    {"UnknownEventName", "export event.hits -o out.dat --event other", 2, "--event"},
    {"ImportToText", "import event.hits -o out.hits", 2, ".h5"},
    {"FlashersFolderMissing", "import --flashers runs.hits -o no/such/out.h5", 5, "no/such"},
    {"UnknownHypothesis", "reconstruct event.hits --hypothesis tau", 2, "--hypothesis"},
    {"NoEvents", "reconstruct", 2, "EVENT"},
    {"NegativeModelError", "reconstruct event.hits --model-error -1", 2, "--model-error"},
    {"OneModelToCompare", "compare event.hits", 2, "second model"},
    {"ThreeModelsToCompare", "compare event.hits --ice a --ice b --ice c", 2, "at most two"},
    {"TwoModelsAndWithout", "compare event.hits --ice a --ice b --without tilt", 2, "--without"},
    {"PictureOfAnotherKind", "compare event.hits --without tilt --picture out.png", 2, ".svg"},
    {"SkyMapPictureOfAnotherKind", "reconstruct event.hits --skymap-picture out.png", 2,
     "--skymap-picture: found \"out.png\""},
    {"UnknownEngine", "validate --reference . --engine fast", 2, "--engine: found \"fast\""},
    {"UnknownReferenceSet", "validate --reference . --only other", 2, "unknown reference set"},
    {"OutputFolderMissing", "simulate --cascade 20,-40,-300,70,130,1 -o no/such/out.h5", 5, "no/such"},
    {"OutputIsAFolder", "simulate --cascade 20,-40,-300,70,130,1 -o /proc/out.h5", 5, "/proc"},
    {"JsonFolderMissing", cascade + "--json no/such/out.json", 5, "no/such"},
    {"InfoJsonFolderMissing", "info --json no/such/out.json", 5, "no/such"},
    {"ExportFolderMissing", "export event.hits -o no/such/out.dat", 5, "no/such"},
    {"ImportFolderMissing", "import event.hits -o no/such/out.h5", 5, "no/such"},
    {"FitJsonFolderMissing", "reconstruct event.hits --json no/such/out.json", 5, "no/such"},
    {"OutputIsTheInput", "export event.hits -o ./event.hits", 2, "are the same file"},
    {"FitOverItsEvent", "reconstruct event.hits --json event.hits", 2, "--json and EVENT are the same file"},
    {"TwoOutputsInOne", cascade + "--json out.h5", 2, "--output and --json are the same file, out.h5"},
    {"GivenTwice", cascade + "--seed 1 --seed 2", 2, "--seed is given more than once"},
    {"MapOfAnotherKind", "reconstruct event.hits --skymap map.txt", 2, "ends in .h5"},
    {"PageOfAnotherKind", "view event.hits -o page.pdf", 2, "ends in .html"},
    {"BandOutsideTheIce", "info --with absorption-layer.factor=5,absorption-layer.depth=300", 2,
     "absorption-layer.depth: found 300"},
    {"PictureFolderMissing", "compare event.hits --without tilt --picture no/such/out.svg", 5, "no/such"},
};

INSTANTIATE_TEST_SUITE_P(CommandLine, WrongUsage, testing::ValuesIn(cases), name_of_case);

TEST(FullDisk, IsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  const TemporaryFolder folder;
  const Outcome outcome = run_floe(folder.path(), "info >/dev/full");
  expect_error(outcome, 5, "standard output");
}

}  // namespace
}  // namespace floe::test
