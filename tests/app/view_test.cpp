// floe view: the page needs nothing but itself, holds what it shows, and works in a browser.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

#include "data/event_files.h"
#include "tests/app/floe_runner.h"
#include "tests/app/wrong_cases.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::string fitted = R"({"events": [{"event": "cascade", "status": "ok", "fit": {"x": 21, "y": -40,
  "z": -300, "time_ns": 1, "zenith_deg": 72, "azimuth_deg": 130, "energy_gev": 420, "covariance":
  [[4,0,0,0,0,0,0],[0,1,0,0,0,0,0],[0,0,1,0,0,0,0],[0,0,0,1,0,0,0],[0,0,0,0,1,0,0],[0,0,0,0,0,1,0],
  [0,0,0,0,0,0,100]]}}]})";

class View : public ::testing::Test {
 protected:
  Outcome floe_well(const std::string& arguments) const {
    const Outcome outcome = run_floe(folder_.path(), arguments);
    EXPECT_EQ(outcome.code, 0) << "floe " << arguments << "\n" << outcome.err;
    return outcome;
  }
  void simulate_cascade() const {
    floe_well("simulate --cascade 20,-40,-300,70,130,400 --quiet -o event.h5");
    write_bytes(folder_.path() / "fit.json", fitted);
  }
  std::string page(const std::string& name) const { return bytes_of(folder_.path() / name); }
  TemporaryFolder folder_;
};

// The data that stand in a page.
Json data_of(const std::string& page) {
  const std::string begin = "id=\"data\">";
  const auto from = page.find(begin) + begin.size();
  return Json::parse(page.substr(from, page.find("</script>", from) - from));
}

TEST_F(View, WritesOnePageThatNeedsNothingElse) {
  simulate_cascade();
  const Outcome outcome =
      floe_well("view event.h5 --fit fit.json --ice south-pole -o page.html --json same.json");
  EXPECT_NE(outcome.out.find("page.html: event cascade"), std::string::npos) << outcome.out;
  EXPECT_EQ(files_in(folder_.path()),
            (std::set<std::string>{"event.h5", "fit.json", "page.html", "same.json"}));
  const std::string text = page("page.html");
  for (const char* outside :
       {"http:", "https:", "src=", "url(", "@import", "fetch(", "import(", "XMLHttpRequest"})
    EXPECT_EQ(text.find(outside), std::string::npos) << outside;
  EXPECT_EQ(text.find("{{"), std::string::npos);
  const Json data = data_of(text);
  EXPECT_EQ(data, Json::parse(page("same.json")));

  const Event event = read_event_file(folder_.path() / "event.h5").events.at(0);
  EXPECT_EQ(data["hits"], event.hits.size());
  EXPECT_EQ(data["detector"]["x"].size(), 5160u);
  double charge = 0, in_bins = 0;
  for (const Json& curve : data["curves"]) {
    charge += curve["charge"].get<double>();
    for (const Json& q : curve["charges"]) in_bins += q.get<double>();
    EXPECT_EQ(curve["bins"].size(), curve["charges"].size());
  }
  EXPECT_NEAR(charge, static_cast<double>(event.hits.size()), 1e-3 * charge);
  EXPECT_NEAR(in_bins, charge, 1e-3 * charge);
  EXPECT_EQ(data["truth"][0]["energy"], 400);
  EXPECT_EQ(data["fits"][0]["zenith_deg"], 72);
  EXPECT_EQ(data["fits"][0]["errors"][0], 2);  // the root of the variance
  EXPECT_NEAR(data["ice"]["flow_azimuth_deg"].get<double>(), 130, 1e-9);
  EXPECT_EQ(data["ice"]["z"].size(), data["ice"]["absorption"].size());
}

TEST_F(View, NamesThePageAfterTheFileAndShowsNoIceUnlessAsked) {
  write_bytes(folder_.path() / "named.hits",
              "HIT 20 30 100.0 400.0 1.5 0.5 1.5 0.5\nHIT 999 3 1 400 1 1 1 1\n");
  const Outcome outcome = floe_well("view named.hits");
  EXPECT_NE(outcome.err.find("1 hits are of modules that the detector ic86"), std::string::npos)
      << outcome.err;
  const Json data = data_of(page("named.html"));
  EXPECT_TRUE(data["ice"].is_null());
  EXPECT_EQ(data["curves"].size(), 1u);
  EXPECT_EQ(data["curves"][0]["first"], 100);
}

TEST_F(View, ShowsTheEventThatIsNamedAndWhereItsLightCameFrom) {
  write_bytes(folder_.path() / "runs.toml",
              "[defaults]\nphotons = 1e6\n[[run]]\nmodule = [63, 20]\n[[run]]\nmodule = [36, 20]\n");
  floe_well("simulate --flashers runs.toml --quiet -o runs.h5");
  const Outcome outcome = floe_well("view runs.h5 -o first.html");
  EXPECT_NE(outcome.out.find("--event ID shows another"), std::string::npos) << outcome.out;
  floe_well("view runs.h5 --event 36,20 -o second.html");
  EXPECT_EQ(data_of(page("first.html"))["light"][0]["label"], "flasher 63,20");
  EXPECT_EQ(data_of(page("second.html"))["light"][0]["label"], "flasher 36,20");
  floe_well("simulate --point 1,2,-300 --photons 1e5 --quiet -o point.h5");
  floe_well("view point.h5");
  EXPECT_EQ(data_of(page("point.html"))["light"][0]["y"], 2);
}

TEST_F(View, SaysWhyThereIsNoFitAndShowsTwo) {
  simulate_cascade();
  write_bytes(folder_.path() / "none.json",
              R"({"events": [{"event": "cascade", "status": "not_enough_light", "reason": "3 modules", "fit":
              {"x": null, "y": null, "z": null, "covariance": null}}]})");
  const Outcome outcome = floe_well("view event.h5 --fit none.json --quiet");
  EXPECT_NE(outcome.err.find("no fit to show: not_enough_light: 3 modules"), std::string::npos)
      << outcome.err;
  EXPECT_TRUE(data_of(page("event.html"))["fits"].empty());

  const Json fit = Json::parse(fitted)["events"][0]["fit"];
  const Json two = {{"events", {{{"event", "cascade"}, {"status", "ok"}, {"fits", {fit, fit}}}}}};
  write_bytes(folder_.path() / "two.json", two.dump());
  floe_well("view event.h5 --fit two.json");
  EXPECT_EQ(data_of(page("event.html"))["fits"][1]["name"], "fit B");
}

TEST_F(View, IsNotFooledByNamesInTheData) {
  // A name that would end the data's element, or the page, if it stood there as it is.
  write_bytes(folder_.path() / "a<script>{{data}}.hits", "HIT 20 30 100.0 400.0 1.5 0.5 1.5 0.5\n");
  floe_well("view 'a<script>{{data}}.hits' -o page.html");
  EXPECT_EQ(data_of(page("page.html"))["event"], "a<script>{{data}}");
}

// A data set of compounds with one row type, as other programs write it.
void write_table(hid_t file, const char* name, hid_t type, hsize_t rows, const void* values) {
  const hid_t space = H5Screate_simple(1, &rows, nullptr);
  const hid_t table = H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(H5Dwrite(table, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), 0);
  H5Dclose(table);
  H5Sclose(space);
}

void add_waveforms(const fs::path& path, int launches) {
  struct Row {
    std::uint64_t event;
    std::int32_t repeat, string, dom, launch;
    char digitiser[8];
    double time_ns, sample_ns, millivolt_per_count, baseline;
    std::uint64_t first_sample, sample_count;
  };
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(Row)), text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, 8);
  const auto column = [&](const char* name, std::size_t offset, hid_t kind) {
    H5Tinsert(type, name, offset, kind);
  };
  column("event", offsetof(Row, event), H5T_NATIVE_UINT64);
  column("repeat", offsetof(Row, repeat), H5T_NATIVE_INT32);
  column("string", offsetof(Row, string), H5T_NATIVE_INT32);
  column("dom", offsetof(Row, dom), H5T_NATIVE_INT32);
  column("launch", offsetof(Row, launch), H5T_NATIVE_INT32);
  column("digitiser", offsetof(Row, digitiser), text);
  column("time_ns", offsetof(Row, time_ns), H5T_NATIVE_DOUBLE);
  column("sample_ns", offsetof(Row, sample_ns), H5T_NATIVE_DOUBLE);
  column("millivolt_per_count", offsetof(Row, millivolt_per_count), H5T_NATIVE_DOUBLE);
  column("baseline", offsetof(Row, baseline), H5T_NATIVE_DOUBLE);
  column("first_sample", offsetof(Row, first_sample), H5T_NATIVE_UINT64);
  column("sample_count", offsetof(Row, sample_count), H5T_NATIVE_UINT64);
  std::vector<Row> rows;
  std::vector<std::int32_t> counts;
  for (int launch = 0; launch < launches; ++launch) {
    Row row{0, launch, 79, 31, launch, "atwd0", 120, 3.3, 0.125, 100, counts.size(), 128};
    rows.push_back(row);
    for (int i = 0; i < 128; ++i)
      counts.push_back(100 + (i > 20 ? static_cast<int>(800 * std::exp(-(i - 20) / 15.0)) : 0));
  }
  write_table(file, "waveforms", type, rows.size(), rows.data());
  const hid_t count = H5Tcreate(H5T_COMPOUND, sizeof(std::int32_t));
  H5Tinsert(count, "counts", 0, H5T_NATIVE_INT32);
  write_table(file, "samples", count, counts.size(), counts.data());
  for (const hid_t made : {count, text, type}) H5Tclose(made);
  H5Fclose(file);
}

TEST_F(View, ShowsDigitisedWaveformsInMillivolts) {
  simulate_cascade();
  add_waveforms(folder_.path() / "event.h5", 2);
  floe_well("view event.h5");
  const Json data = data_of(page("event.html"));
  ASSERT_EQ(data["waveforms"].size(), 1u);  // of the first repetition
  const Json& wave = data["waveforms"][0];
  EXPECT_EQ(data["detector"]["string"][wave["module"].get<std::size_t>()], 79);
  EXPECT_EQ(wave["millivolts"].size(), 128u);
  EXPECT_EQ(wave["millivolts"][0], 0);
  EXPECT_NEAR(wave["millivolts"][21].get<double>(), 0.125 * std::floor(800 * std::exp(-1 / 15.0)), 1e-9);
  EXPECT_EQ(wave["digitiser"], "atwd0");
}

// Chromium without a window: what it made of the page, or nothing where there is none.
std::string chromium() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (std::system((std::string("command -v ") + name + " >/dev/null 2>&1").c_str()) == 0) return name;
  return "";
}

TEST_F(View, WorksInABrowserWithoutANetwork) {
  const std::string browser = chromium();
  if (browser.empty()) GTEST_SKIP() << "no Chromium is installed: the page is not opened in a browser";
  simulate_cascade();
  add_waveforms(folder_.path() / "event.h5", 1);
  floe_well("view event.h5 --fit fit.json --ice south-pole -o page.html");
  const std::string start =
      "cd '" + folder_.path().string() + "' && timeout 60 " + browser +
      " --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir=profile "
      "--window-size=1200,800 --virtual-time-budget=3000 ";
  const std::string link =
      "'file://" + (folder_.path() / "page.html").string() + "#module=79,31&theme=dark' ";
  ASSERT_EQ(std::system((start + "--dump-dom " + link + ">dom.html 2>log").c_str()), 0) << page("log");
  const std::string dom = page("dom.html");
  const Json data = data_of(page("page.html"));
  EXPECT_NE(dom.find("data-ready=\"true\""), std::string::npos) << "the page's program stopped\n"
                                                                << page("log");
  EXPECT_NE(dom.find("data-selected=\"79,31\""), std::string::npos);
  EXPECT_NE(dom.find("data-theme=\"dark\""), std::string::npos);
  EXPECT_NE(dom.find("data-lit-modules=\"" + std::to_string(data["curves"].size()) + "\""),
            std::string::npos);
  EXPECT_NE(dom.find(">atwd0</b>"), std::string::npos);
  EXPECT_NE(dom.find("fit: vertex 1.0 m and direction 2.0 deg from the truth, energy 5.0% off."),
            std::string::npos);
  EXPECT_NE(dom.find("Ice: south-pole"), std::string::npos);

  ASSERT_EQ(std::system((start + "--screenshot=page.png " + link + ">log 2>&1").c_str()), 0) << page("log");
  const std::string picture = page("page.png");
  EXPECT_EQ(picture.substr(1, 3), "PNG");
  EXPECT_GT(picture.size(), 50000u);  // an empty page of this size has some 5000 bytes
}

TEST_F(View, IsWorkedWithKeysAndMouse) {
  const std::string browser = chromium();
  if (browser.empty()) GTEST_SKIP() << "no Chromium is installed: the page is not opened in a browser";
  simulate_cascade();
  floe_well("view event.h5 -o page.html");
  const Json data = data_of(page("page.html"));
  std::vector<std::pair<double, std::string>> modules;
  for (const Json& curve : data["curves"]) {
    const auto module = curve["module"].get<std::size_t>();
    modules.emplace_back(-curve["charge"].get<double>(), data["detector"]["string"][module].dump() + "," +
                                                             data["detector"]["dom"][module].dump());
  }
  std::stable_sort(modules.begin(), modules.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  // A user's hand: what it found is left in the document.
  const std::string hand = R"(<script>{
    const seen = document.body.dataset, key = (name) => document.dispatchEvent(new KeyboardEvent("keydown", {key: name}));
    seen.begin = seen.selected;
    key("n"); seen.next = seen.selected;
    key("Escape"); seen.nothing = "[" + seen.selected + "]";
    const view = document.getElementById("view"), place = (type, x, y) => new PointerEvent(type, {clientX: x, clientY: y, pointerId: 1, button: 0, bubbles: true});
    view.setPointerCapture = () => {};
    const box = view.getBoundingClientRect();
    for (let y = 5; y < box.height && !seen.selected; y += 4)
      for (let x = 5; x < box.width && !seen.selected; x += 4)
        for (const type of ["pointerdown", "pointerup"]) view.dispatchEvent(place(type, box.left + x, box.top + y));
    seen.clicked = seen.selected;
    key("d"); key("?"); key("t"); key("e"); key("}"); key("{");
    seen.helped = String(!document.getElementById("help").hidden);
    setTimeout(() => {
      seen.window = document.getElementById("window").textContent;
      const play = document.getElementById("play");
      key(" "); seen.playing = String(play.textContent !== "\u25b6"); key(" "); seen.stopped = String(play.textContent === "\u25b6");
    }, 300);
  }</script></body>)";
  std::string text = page("page.html");
  text.replace(text.rfind("</body>"), 7, hand);
  write_bytes(folder_.path() / "hand.html", text);
  ASSERT_EQ(
      std::system(("cd '" + folder_.path().string() + "' && timeout 60 " + browser +
                   " --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir=profile "
                   "--window-size=1200,800 --virtual-time-budget=5000 --dump-dom 'file://" +
                   (folder_.path() / "hand.html").string() + "' >dom.html 2>log")
                      .c_str()),
      0)
      << page("log");
  const std::string dom = page("dom.html");
  const auto seen = [&](const std::string& name) {
    const auto at = dom.find("data-" + name + "=\"");
    return at == dom.npos
               ? "none"
               : dom.substr(at + name.size() + 7, dom.find('"', at + name.size() + 7) - at - name.size() - 7);
  };
  EXPECT_EQ(seen("begin"), modules[0].second);
  EXPECT_EQ(seen("next"), modules[1].second);
  EXPECT_EQ(seen("nothing"), "[]");
  EXPECT_NE(seen("clicked").find(','), std::string::npos) << seen("clicked");
  EXPECT_EQ(seen("helped"), "true");
  EXPECT_NE(seen("window").find(" ns"), std::string::npos) << seen("window");  // no longer all times
  EXPECT_EQ(seen("playing") + seen("stopped"), "truetrue");
}

const WrongCase cases[] = {
    {"NoFile", "view", 2, "EVENTS"},
    {"MissingFile", "view none.h5", 3, "none.h5"},
    {"UnknownEvent", "view event.hits --event other", 2, "--event: found \"other\"; expected one of event"},
    {"MissingFit", "view event.hits --fit none.json", 3, "none.json"},
    {"FitThatIsNoJson", "view event.hits --fit event.hits", 3, "what is not JSON"},
    {"FitOfAnotherKind", "view event.hits --fit other.json", 3, "other JSON"},
    {"FitOfAnotherEvent", "view event.hits --fit fit.json", 3, "no event 'event', but cascade"},
    {"FitWithoutStatus", "view event.hits --fit half.json", 3, "other JSON"},
    {"FolderMissing", "view event.hits -o no/such/page.html", 5, "no/such"},
    {"UnknownIce", "view event.hits --ice nowhere", 3, "nowhere"},
};

class WrongView : public ::testing::TestWithParam<WrongCase> {};
TEST_P(WrongView, IsSaidAndLeavesNothing) {
  const TemporaryFolder folder;
  write_readable_event(folder.path() / "event.hits");
  write_bytes(folder.path() / "fit.json", fitted);
  write_bytes(folder.path() / "other.json", "{\"results\": 3}");
  write_bytes(folder.path() / "half.json", "{\"events\": [{\"event\": \"event\"}]}");
  expect_said_and_nothing_left(folder.path(), GetParam());
}
INSTANTIATE_TEST_SUITE_P(Uses, WrongView, ::testing::ValuesIn(cases), name_of_case);

}  // namespace
}  // namespace floe::test
