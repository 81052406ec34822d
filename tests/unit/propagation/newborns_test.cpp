// Photons that are born many at a time against what one photon's stream and the ice's functions say.
#include "propagation/engine/newborns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "data/base/constants.h"
#include "propagation/sources/flasher.h"
#include "tests/physics/engine/test_scenes.h"

namespace floe {
namespace {

using test::make_model;
using test::uniform_tables;

constexpr int lanes = Newborns::count;

// Ice with powers of the wavelength and thermal absorption; modules that see some wavelengths better.
Model colourful_model() {
  IceTables tables = uniform_tables({20, 80});
  tables.wavelength = {0.9, 1.08, 6954, 6618, {}, {}, {}};
  std::vector<Module> modules = test::modules_at({Vec3::Zero(), Vec3(30, 0, 0)});
  modules[1].high_qe_spectrum = true;
  ModuleAcceptance acceptance;
  acceptance.high_qe = HighQeRatio({{300, 1.1}, {400, 1.35}, {600, 1.2}});
  return make_model(tables, modules, acceptance);
}

// An isotropic point source draws one number for the wavelength and two for the direction.
constexpr int draws_of_source = 3;
PointSource isotropic_source(WavelengthSpectrum spectrum = WavelengthSpectrum({{0, 300}, {1, 600}})) {
  return PointSource(Vec3(1, 2, 3), 4, 1000, spectrum);
}

struct Birth {
  explicit Birth(const Model& model)
      : acceptance(*model.detector, model.acceptance), wavelengths(*model.ice, acceptance) {}
  void operator()(const Source& source, const PhotonBatch& batch, std::uint64_t first) {
    bear_photons(source, batch, wavelengths, first, newborns);
  }
  PhotonAcceptance acceptance;
  WavelengthTable wavelengths;
  Newborns newborns{};
};

TEST(Newborns, HaveTheirPhotonsStreams) {
  const Model model = colourful_model();
  Birth birth(model);
  const PointSource source = isotropic_source();
  for (const double stretch : {1.0, 7.5})
    for (const std::uint64_t first : {std::uint64_t{0}, std::uint64_t{1} << 15, (std::uint64_t{1} << 32) - 17,
                                      std::uint64_t{987654321987654321}})
      for (const std::uint64_t stream : {std::uint64_t{0}, std::uint64_t{1} << 40}) {
        const PhotonBatch batch{(std::uint64_t{5} << 33) + 3, stream, first, 1u << 15, stretch};
        birth(source, batch, first);
        EXPECT_EQ(birth.newborns.first, first);
        std::uint64_t walked = 0;
        for (int i = 0; i < lanes; ++i) {
          RandomStream random(batch.seed, batch.stream, first + static_cast<std::uint64_t>(i));
          const EmittedPhoton photon = source.emit(random);
          ASSERT_EQ(birth.newborns.photons.wavelength[i], photon.wavelength);
          ASSERT_EQ(birth.newborns.photons.nz[i], photon.direction.z());
          // The same again, counted.
          RandomStream counted(batch.seed, batch.stream, first + static_cast<std::uint64_t>(i));
          for (int k = 0; k < draws_of_source; ++k) counted.bits();
          ASSERT_EQ(counted.state(), random.state());

          const double chance = birth.acceptance.walked_share(photon.wavelength);
          const double drawn = random.uniform();
          const bool is_walked = birth.newborns.walked >> i & 1;
          if (std::fabs(drawn - chance) > 1e-3) {
            EXPECT_EQ(is_walked, drawn < chance) << i;
          }
          walked += is_walked;
          const double depth = -std::log(double{random.uniform()}) * stretch;
          ASSERT_NEAR(birth.newborns.absorption_depth[i] / depth, 1, 4e-7) << i;
          ASSERT_EQ(birth.newborns.streams[i].state(), random.state());
        }
        EXPECT_EQ(walked, static_cast<std::uint64_t>(std::popcount(birth.newborns.walked)));
        EXPECT_GT(walked, 0U);
      }
}

TEST(Newborns, AreWalkedUpToTheEndOfTheBatch) {
  const Model model = make_model(uniform_tables({}), {Vec3::Zero()});  // sees every photon
  Birth birth(model);
  for (const std::uint32_t count : {1U, 63U, 64U, 65U, 1000U})
    for (const std::uint64_t start : {0U, 77U}) {
      const PhotonBatch batch{1, 2, start, count};
      std::uint64_t walked = 0;
      for (std::uint64_t first = start; first < start + count; first += lanes) {
        birth(isotropic_source(), batch, first);
        const auto left = std::min<std::uint64_t>(lanes, start + count - first);
        EXPECT_EQ(birth.newborns.walked, left == lanes ? ~std::uint64_t{0} : (std::uint64_t{1} << left) - 1);
        walked += static_cast<std::uint64_t>(std::popcount(birth.newborns.walked));
      }
      EXPECT_EQ(walked, count);
    }
}

// As often as the acceptance says: +-4 standard deviations.
TEST(Newborns, AreWalkedWithTheirChance) {
  const Model model = colourful_model();
  Birth birth(model);
  for (const double wavelength : {320.0, 400.0, 550.0}) {
    const PointSource source = isotropic_source(test::line_at(wavelength));
    constexpr std::uint32_t count = 1U << 16;
    const PhotonBatch batch{9, 0, 0, count};
    double walked = 0;
    for (std::uint64_t first = 0; first < count; first += lanes) {
      birth(source, batch, first);
      walked += std::popcount(birth.newborns.walked);
    }
    const double chance = birth.acceptance.walked_share(wavelength);
    EXPECT_NEAR(walked / count, chance, 4 * std::sqrt(chance * (1 - chance) / count) + 1e-9) << wavelength;
  }
}

// Exact at whole nanometres, linear in between: off by at most h^2/8 of the second derivative, which is
// f (B/lambda^2)^2 for the thermal absorption, below f 0.0054 beyond 300 nm.
TEST(Newborns, KnowTheFactorsOfTheirWavelength) {
  const Model model = colourful_model();
  Birth birth(model);
  const IceModel& ice = *model.ice;
  const PhotonBatch batch{1, 0, 0, lanes};
  for (const double wavelength : {300.0, 337.0, 400.0, 473.0, 599.0, 650.0}) {
    birth(isotropic_source(test::line_at(wavelength)), batch, 0);
    for (int i = 0; i < lanes; ++i) {
      ASSERT_NEAR(birth.newborns.scattering_power[i] / ice.scattering_power_factor(wavelength), 1, 1e-5);
      ASSERT_NEAR(birth.newborns.absorption_dust[i] / ice.absorption_dust_factor(wavelength), 1, 1e-5);
      ASSERT_NEAR(birth.newborns.absorption_thermal[i] / ice.absorption_thermal_factor(wavelength), 1, 1e-4);
      ASSERT_NEAR(birth.newborns.slowness[i] * speed_of_light / group_index(wavelength), 1, 1e-6);
    }
  }
  birth(isotropic_source(), batch, 0);
  for (int i = 0; i < lanes; ++i) {
    const double wavelength = birth.newborns.photons.wavelength[i];
    ASSERT_NEAR(birth.newborns.scattering_power[i] / ice.scattering_power_factor(wavelength), 1, 1e-5);
    ASSERT_NEAR(birth.newborns.absorption_dust[i] / ice.absorption_dust_factor(wavelength), 1, 1e-5);
    ASSERT_NEAR(birth.newborns.absorption_thermal[i] / ice.absorption_thermal_factor(wavelength), 1, 8e-4);
    ASSERT_NEAR(birth.newborns.slowness[i] * speed_of_light / group_index(wavelength), 1, 1e-5);
  }
}

// Outside the table's range the ends hold, and for the refractive index those of its own range.
TEST(Newborns, OutsideTheTablesRangeTheEndsHold) {
  const Model model = colourful_model();
  Birth birth(model);
  const PhotonBatch batch{1, 0, 0, lanes};
  struct Case {
    double wavelength, at, index_at;
  };
  for (const auto& [wavelength, at, index_at] :
       {Case{150, 200, 250}, Case{200, 200, 250}, Case{1000, 1000, 700}, Case{1500, 1000, 700}}) {
    birth(isotropic_source(test::line_at(wavelength)), batch, 0);
    for (int i = 0; i < lanes; ++i) {
      ASSERT_NEAR(birth.newborns.scattering_power[i] / model.ice->scattering_power_factor(at), 1, 1e-4);
      ASSERT_NEAR(birth.newborns.absorption_thermal[i] / model.ice->absorption_thermal_factor(at), 1, 1e-3);
      ASSERT_NEAR(birth.newborns.slowness[i] * speed_of_light / group_index(index_at), 1, 1e-6);
    }
  }
}

}  // namespace
}  // namespace floe
