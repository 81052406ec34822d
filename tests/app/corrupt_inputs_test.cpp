// Corrupt inputs: each gives exit code 3, one message that says where and what, and no output file.
#include <gtest/gtest.h>

#include <functional>

#include "data/event_files.h"
#include "tests/app/floe_runner.h"
#include "tests/app/model_directory.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

namespace fs = std::filesystem;

struct Case {
  std::string name;
  std::function<void(const fs::path&)> spoil;  // the file that it is given
  std::string said;
};

std::ostream& operator<<(std::ostream& stream, const Case& test_case) {
  return stream << test_case.name;
}

std::function<void(const fs::path&)> line(std::size_t number, const std::string& text) {
  return [=](const fs::path& file) { replace_line(file, number, text); };
}
std::function<void(const fs::path&)> whole(const std::string& text) {
  return [=](const fs::path& file) { write_bytes(file, text); };
}
std::function<void(const fs::path&)> more(const std::string& text) {
  return [=](const fs::path& file) { append_line(file, text); };
}
std::function<void(const fs::path&)> first_lines(std::size_t count) {
  return [=](const fs::path& file) { keep_lines(file, count); };
}
void removed(const fs::path& file) {
  fs::remove(file);
}
void unreadable_bytes(const fs::path& file) {
  write_bytes(file, std::string("\x7f"
                                "ELF\0\1\2\xff\xfe",
                                9));
}

// --- Ice-model directories: name, file in it, how it is spoilt, what must be said ---------------------

struct IceCase : Case {
  std::string file;
};

class CorruptIce : public testing::TestWithParam<IceCase> {};

TEST_P(CorruptIce, IsRefusedWithOneMessage) {
  const TemporaryFolder folder;
  const fs::path ice = folder.path() / "my-ice";
  write_model_directory(ice);
  ASSERT_EQ(run_floe(folder.path(), "info --ice my-ice --quiet").code, 0)
      << "the model must be good at first";
  GetParam().spoil(ice / GetParam().file);
  const auto before = files_in(folder.path());
  const Outcome outcome = run_floe(
      folder.path(), "simulate --ice my-ice --cascade 20,-40,-300,70,130,1 -o out.h5 --json out.json");
  expect_error(outcome, 3, GetParam().said);
  EXPECT_NE(outcome.err.find("expected"), std::string::npos) << outcome.err;
  EXPECT_EQ(files_in(folder.path()), before);
}

const IceCase ice_cases[] = {
    {{"LayersMissing", removed, "icemodel.dat"}, "icemodel.dat"},
    {{"LayersEmpty", whole(""), "icemodel.dat"}, "icemodel.dat"},
    {{"LayersWithLetter", line(5, "1145 0.1x 0.03 -10 0 0 1"), "icemodel.dat:5"}, "icemodel.dat"},
    {{"LayersWithNan", line(5, "1145 nan 0.03 -10 0 0 1"), "icemodel.dat:5"}, "icemodel.dat"},
    {{"LayersWithInfinity", line(5, "1145 0.1 inf -10 0 0 1"), "icemodel.dat:5"}, "icemodel.dat"},
    {{"LayersOutOfOrder", [](const fs::path& f) { swap_lines(f, 5, 9); }, "icemodel.dat:6"}, "icemodel.dat"},
    {{"LayersNotUniform", line(5, "1147 0.1 0.03 -10 0 0 1"), "icemodel.dat:5: found a step of 12 m"},
     "icemodel.dat"},
    {{"LayersWithNegativeScattering", line(5, "1145 -0.1 0.03 -10 0 0 1"),
      "icemodel.dat:5: found -0.1 for effective scattering"},
     "icemodel.dat"},
    {{"LayersWithNegativeAbsorption", line(5, "1145 0.1 -0.03 -10 0 0 1"),
      "icemodel.dat:5: found -0.03 for dust absorption"},
     "icemodel.dat"},
    {{"LayersWithNegativeStrength", line(5, "1145 0.1 0.03 -10 0 0 -1"),
      "icemodel.dat:5: found -1 for birefringence strength"},
     "icemodel.dat"},
    {{"LayersWithThreeColumns", line(5, "1145 0.1 0.03"), "icemodel.dat:5"}, "icemodel.dat"},
    {{"LayersWithNineColumns", line(5, "1145 0.1 0.03 -10 0 0 1 1 1"), "icemodel.dat:5"}, "icemodel.dat"},
    {{"LayersOfBytes", unreadable_bytes, "icemodel.dat"}, "icemodel.dat"},
    // More is taken out for the crystals than there is.
    {{"LayersWithoutScattering", line(60, "1695 0.0001 0.03 -10 0 0 3"), "scattering"}, "icemodel.dat"},
    {{"WavelengthLawMissing", removed, "icemodel.par"}, "icemodel.par"},
    {{"WavelengthLawOfThreeRows", first_lines(3), "icemodel.par"}, "icemodel.par"},
    {{"WavelengthLawWithInfinity", line(2, "inf 0"), "icemodel.par:2"}, "icemodel.par"},
    {{"BubblesOfTwoNumbers", whole("6 1350\n"), "icemodel.bbl"}, "icemodel.bbl"},
    {{"ConfigurationMissing", removed, "cfg.txt"}, "cfg.txt"},
    {{"ConfigurationCutShort", whole("5\n1\n0.35\n"), "cfg.txt"}, "cfg.txt"},
    {{"ConfigurationWithLetter", whole("5\none\n0.35\n0.9\n130\n0\n0\n"), "cfg.txt:2"}, "cfg.txt"},
    {{"ConfigurationWithFractionTwo", whole("5\n1\n2\n0.9\n130\n0\n0\n"), "cfg.txt:3"}, "cfg.txt"},
    {{"ConfigurationWithCosineTwo", whole("5\n1\n0.35\n2\n130\n0\n0\n"), "cfg.txt:4"}, "cfg.txt"},
    {{"ConfigurationOfElevenNumbers",
      [](const fs::path& f) {
        const std::string text = bytes_of(f);
        const auto last = text.find_last_of('\n', text.size() - 2);
        write_bytes(f, text.substr(0, last + 1));
      },
      "cfg.txt"},
     "cfg.txt"},
    {{"VersionInWords", whole("ten\n"), "version:1"}, "version"},
    {{"VersionUnknown", whole("7\n"), "version:1"}, "version"},
    {{"TiltDistancesMissing", removed, "tilt.dat without tilt.par"}, "tilt.par"},
    {{"TiltWithoutOrigin", whole("50 10\n86 400\n"), "tilt.par"}, "tilt.par"},
    {{"TiltOfOtherWidth", line(2, "2000 0"), "tilt.dat:2"}, "tilt.dat"},
    {{"TiltWithNan", line(2, "2000 0 nan"), "tilt.dat:2"}, "tilt.dat"},
    {{"TiltMapWithoutGrid", whole("1500 0 0 0 0\n2000 0 0 0 0\n"), "tilt.map without tilt.set"}, "tilt.map"},
    {{"GeometryMissing", removed, "geo-f2k"}, "geo-f2k"},
    {{"GeometryEmpty", whole(""), "geo-f2k"}, "geo-f2k"},
    {{"GeometryWithLetter", line(3, "m 1000 -256.14 -521.O8 -1500 1 3"), "geo-f2k:3"}, "geo-f2k"},
    {{"GeometryInTheWrongFrame", line(3, "m 1000 -256.14 -521.08 480 1 3"), "geo-f2k:3"}, "geo-f2k"},
    {{"GeometryWithModuleTwice", line(3, "m 1000 -256.14 -521.08 -1500 1 2"), "geo-f2k:3"}, "geo-f2k"},
    {{"EfficiencyOfUnknownModule", more("99 1 1.0"), "eff-f2k:5161"}, "eff-f2k"},
    {{"EfficiencyNegative", line(3, "1 3 -1"), "eff-f2k:3"}, "eff-f2k"},
    {{"EfficiencyOfUnknownType", line(3, "1 3 1 7"), "eff-f2k:3"}, "eff-f2k"},
    {{"VoltageWithLetter", line(3, "1 3 l300"), "hvs-f2k:3"}, "hvs-f2k"},
    {{"VoltagesAllOff", whole("1 1 0\n"), "hvs-f2k"}, "hvs-f2k"},
    {{"AxisOfNoLength", line(3, "1 3 0 0 0 1"), "cx.dat:3"}, "cx.dat"},
    {{"CableOfUnknownModule", more("99 1 90 5"), "dx.dat:5161"}, "dx.dat"},
    {{"HoleOfUnknownString", more("99 0 0"), "str-f2k:87"}, "str-f2k"},
    {{"AngularAcceptanceEmpty", whole(""), "as.dat"}, "as.dat"},
    {{"AngularAcceptanceWithNan", whole("0.68\nnan\n"), "as.dat:2"}, "as.dat"},
    {{"AngularAcceptanceAboveMaximum", whole("0.5\n0.9\n"), "as.dat"}, "as.dat"},
    {{"SpectrumThatFalls", whole("0 300\n0.6 400\n0.5 500\n1 600\n"), "wv.dat"}, "wv.dat"},
    {{"SpectrumThatEndsEarly", whole("0 300\n0.9 600\n"), "wv.dat"}, "wv.dat"},
    {{"HighEfficiencyWithLetter", whole("300 1.35\n600 l.35\n"), "wv.rde:2"}, "wv.rde"},
    {{"HighEfficiencyMissing", removed, "wv.rde"}, "wv.rde"},
};

INSTANTIATE_TEST_SUITE_P(Files, CorruptIce, testing::ValuesIn(ice_cases),
                         [](const auto& given) { return given.param.name; });

TEST(CorruptIce, DirectoryMissing) {
  const TemporaryFolder folder;
  expect_error(run_floe(folder.path(), "info --ice no-ice --json out.json"), 3,
               "no-ice: found no such directory");
  EXPECT_TRUE(files_in(folder.path()).empty());
}

TEST(CorruptIce, FileInsteadOfDirectory) {
  const TemporaryFolder folder;
  write_bytes(folder.path() / "ice", "text\n");
  expect_error(run_floe(folder.path(), "info --ice ice"), 3, "ice: found a file");
}

TEST(CorruptIce, DetectorMissing) {
  const TemporaryFolder folder;
  expect_error(run_floe(folder.path(), "info --detector geo-f2k"), 3, "geo-f2k: found no such file");
}

// --- Event files: name of the file, what it holds, the command that reads it -------------------------

struct EventCase : Case {
  std::string file, command;
};

class CorruptEvents : public testing::TestWithParam<EventCase> {};

TEST_P(CorruptEvents, AreRefusedWithOneMessage) {
  const TemporaryFolder folder;
  GetParam().spoil(folder.path() / GetParam().file);
  const auto before = files_in(folder.path());
  const Outcome outcome = run_floe(folder.path(), GetParam().command);
  expect_error(outcome, 3, GetParam().said);
  EXPECT_EQ(files_in(folder.path()), before);
}

const std::string good_hit = "HIT 20 30 100.0 400.0 1.5 0.5 1.5 0.5\n";

// Whole files of one event, to be cut.
void write_event(const fs::path& file) {
  EventFileWriter writer(file, {});
  writer.begin_event("event", {});
  Hit hit;
  hit.module = {20, 30};
  writer.append(std::vector<Hit>(1000, hit));
  writer.close();
}
void truncated(const fs::path& file) {
  fs::resize_file(file, fs::file_size(file) / 2);
}
void truncated_event(const fs::path& file) {
  write_event(file);
  truncated(file);
}
void truncated_gzip(const fs::path& file) {
  Event event;
  event.id = "event";
  for (int i = 0; i < 1000; ++i) {
    Hit hit;
    hit.module = {20, 1 + i % 60};
    hit.time = 0.37 * i * i;
    event.hits.push_back(hit);
  }
  export_events(file, EventFormat::dat, std::vector<Event>{event});
  truncated(file);
}

const std::string reconstruct = "reconstruct --json out.json ", import = "import -o out.h5 ",
                  simulate = "simulate -o out.h5 --f2k ";

const EventCase event_cases[] = {
    {{"Missing", [](const fs::path&) {}, "event.h5"}, "event.h5", reconstruct + "event.h5"},
    {{"TruncatedHdf5", truncated_event, "event.h5"}, "event.h5", reconstruct + "event.h5"},
    {{"TruncatedHdf5Exported", truncated_event, "event.h5"}, "event.h5", "export event.h5 -o out.dat"},
    {{"TruncatedHdf5Compared", truncated_event, "event.h5"},
     "event.h5",
     "compare event.h5 --without tilt --picture out.svg"},
    {{"EmptyHdf5", whole(""), "event.h5"}, "event.h5", reconstruct + "event.h5"},
    {{"TextNamedHdf5", whole(good_hit), "event.h5"}, "event.h5", reconstruct + "event.h5"},
    {{"BytesNamedHdf5", unreadable_bytes, "event.h5"}, "event.h5", reconstruct + "event.h5"},
    {{"UnknownSuffix", whole(good_hit), "event.root"}, "event.root", reconstruct + "event.root"},
    {{"EmptyHits", whole(""), "event.hits"}, "event.hits", reconstruct + "event.hits"},
    {{"OnlyComments", whole("# nothing\n\n"), "event.hits"}, "event.hits", reconstruct + "event.hits"},
    {{"HitWithLetter", whole(good_hit + "HIT 20 3O 1 400 1 1 1 1\n"), "event.hits:2"},
     "event.hits",
     reconstruct + "event.hits"},
    {{"HitWithNan", whole("HIT 20 30 nan 400 1 1 1 1\n"), "event.hits:1"},
     "event.hits",
     reconstruct + "event.hits"},
    {{"HitCutShort", whole(good_hit + "HIT 20 30 1 400 1\n"), "event.hits:2"},
     "event.hits",
     import + "event.hits"},
    {{"HitInDegrees", whole("HIT 20 30 1 400 90 180 90 180\n"), "event.hits:1"},
     "event.hits",
     import + "event.hits"},
    {{"HitOfStringZero", whole("HIT 0 30 1 400 1 1 1 1\n"), "event.hits:1"},
     "event.hits",
     import + "event.hits"},
    {{"HitOfUnknownString", whole(good_hit + "HIT 99 30 1 400 1 1 1 1\n"), "99"},
     "event.hits",
     reconstruct + "event.hits"},
    {{"HitOfUnknownModule", whole(good_hit + "HIT 20 61 1 400 1 1 1 1\n"), "61"},
     "event.hits",
     reconstruct + "event.hits"},
    {{"UnknownKeyword", whole("HITS 20 30 1 400 1 1 1 1\n"), "event.hits:1"},
     "event.hits",
     reconstruct + "event.hits"},
    {{"ChargeNegative", whole("20 30 100 1\n20 31 100 -1\n"), "event.dat:2"},
     "event.dat",
     reconstruct + "event.dat"},
    {{"ChargeInfinite", whole("20 30 100 inf\n"), "event.dat:1"}, "event.dat", import + "event.dat"},
    {{"ChargeMissing", whole("20 30 100\n"), "event.dat:1"}, "event.dat", import + "event.dat"},
    {{"TruncatedGzip", truncated_gzip, "event.dat.gz"}, "event.dat.gz", import + "event.dat.gz"},
    {{"ParticlesMissing", [](const fs::path&) {}, "events.f2k"}, "events.f2k", simulate + "events.f2k"},
    {{"NoParticles", whole("V 2000.1.2\n"), "events.f2k"}, "events.f2k", simulate + "events.f2k"},
    {{"ParticleUnknown", whole("TR 1 0 proton 0 0 0 90 0 0 10 0\n"), "events.f2k:1"},
     "events.f2k",
     simulate + "events.f2k"},
    {{"ParticleWithLetter", whole("TR 1 0 e- 0 0 O 90 0 0 10 0\n"), "events.f2k:1"},
     "events.f2k",
     simulate + "events.f2k"},
    {{"ParticleOfNoEnergy", whole("TR 1 0 e- 0 0 0 90 0 0 0 0\n"), "events.f2k:1"},
     "events.f2k",
     simulate + "events.f2k"},
    {{"ParticleOfZenith200", whole("TR 1 0 e- 0 0 0 200 0 0 10 0\n"), "events.f2k:1"},
     "events.f2k",
     simulate + "events.f2k"},
    {{"FlasherOfUnknownModule", [](const fs::path&) {}, "63"},
     "",
     "simulate -o out.h5 --flasher 63,61 --photons 1e6"},
};

INSTANTIATE_TEST_SUITE_P(Files, CorruptEvents, testing::ValuesIn(event_cases),
                         [](const auto& given) { return given.param.name; });

}  // namespace
}  // namespace floe::test
