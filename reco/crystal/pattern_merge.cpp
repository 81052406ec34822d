#include "reco/crystal/pattern_merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "data/base/error.h"

namespace floe {

namespace {

// Everything but which photons they are.
auto settings_of(const CrystalStudy& study) {
  const PatternGrid& grid = study.grid;
  const CrystalIndices& indices = grid.crystal.indices;
  return std::tie(study.name, study.fabric, indices.ordinary, indices.extraordinary, grid.crystal.grains.axes,
                  grid.grain, grid.crossings, grid.chords, grid.seed, grid.angles);
}

void expect_same_run(const PatternFile& share, const PatternFile& first) {
  const auto same_settings = [](const CrystalStudy& a, const CrystalStudy& b) {
    return settings_of(a) == settings_of(b);
  };
  if (share.provenance.version != first.provenance.version ||
      share.provenance.wavelength != first.provenance.wavelength ||
      !std::ranges::equal(share.studies, first.studies, same_settings))
    throw InputError({share.name}, "patterns of another run",
                     fmt::format("the ice, paths, angles, seed and version of {}", first.name),
                     "Shares differ in --first-photon and --photons alone");
}

// The photons of `next` behind those of `study`.
void append(const CrystalStudy& next, const PatternFile& file, const PatternFile& before,
            CrystalStudy& study) {
  const std::uint64_t end = study.grid.first_photon + study.grid.photons;
  if (next.grid.first_photon != end)
    throw InputError({file.name}, fmt::format("photons from number {} on", next.grid.first_photon),
                     fmt::format("number {}, where those of {} end", end, before.name),
                     "Shares follow one another without gap or overlap");
  study.grid.photons += next.grid.photons;
  for (std::size_t i = 0; i < study.patterns.size(); ++i) {
    auto& photons = study.patterns[i].photons;
    const auto& more = next.patterns[i].photons;
    photons.insert(photons.end(), more.begin(), more.end());
  }
}

CrystalStudy studied_anew(CrystalStudy study) {
  for (CrystalPattern& pattern : study.patterns)
    pattern.statistics = PatternStatistics(pattern.photons, pattern.length);
  return study_patterns(study.name, study.fabric, study.grid, std::move(study.patterns));
}

}  // namespace

std::vector<CrystalStudy> merged_patterns(std::vector<PatternFile> shares) {
  for (const PatternFile& share : shares) expect_same_run(share, shares.front());
  std::ranges::stable_sort(shares, {},
                           [](const PatternFile& share) { return share.studies.front().grid.first_photon; });
  std::vector<CrystalStudy> studies = shares.front().studies;
  for (std::size_t k = 1; k < shares.size(); ++k)
    for (std::size_t i = 0; i < studies.size(); ++i)
      append(shares[k].studies[i], shares[k], shares[k - 1], studies[i]);
  for (CrystalStudy& study : studies) study = studied_anew(std::move(study));
  return studies;
}

}  // namespace floe
