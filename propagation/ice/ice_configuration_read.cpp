// cfg.txt: numbers in a strict order, one a line; blocks at the end may be missing.
#include <fmt/format.h>

#include <algorithm>

#include "propagation/ice/ice_files.h"

namespace floe::ice_files {

namespace {

namespace limits = ice_limits;

// Lengths of the file after each block: modules and scattering, flow and scattering anisotropy, hole
// ice, absorption anisotropy, its old form, birefringence.
constexpr std::array<std::size_t, 6> block_ends{4, 7, 12, 15, 16, 28};

// Hands out the numbers one after the other, each checked at its own line.
class Numbers {
 public:
  explicit Numbers(const std::vector<TextLine>& lines) : lines_(lines) {}
  bool holds(std::size_t block_end) const { return lines_.size() >= block_end; }
  double next(const limits::Range& range) {
    const TextLine& line = lines_[next_++];
    expect_fields(line, 1, 1, "one number a line, comments after '#'");
    return read_number(line, 0, range);
  }

 private:
  const std::vector<TextLine>& lines_;
  std::size_t next_ = 0;
};

DiffusionFunction read_function(Numbers& numbers) {
  DiffusionFunction function;
  function.A = numbers.next(limits::diffusion_A);
  function.B = numbers.next(limits::diffusion_B);
  function.C = numbers.next(limits::diffusion_C);
  function.D = numbers.next(limits::diffusion_D);
  return function;
}

HoleIce read_hole_ice(Numbers& numbers) {
  HoleIce hole;
  hole.radius = numbers.next(limits::hole_ice_radius);
  hole.effective_scattering_length = numbers.next(limits::hole_ice_length);
  hole.absorption_length = numbers.next(limits::hole_ice_length);
  hole.simplified_liu_fraction = numbers.next(limits::simplified_liu_fraction);
  hole.mean_cosine = numbers.next(limits::mean_cosine);
  return hole;
}

void expect_whole_blocks(const std::filesystem::path& file, const std::vector<TextLine>& lines) {
  if (std::find(block_ends.begin(), block_ends.end(), lines.size()) != block_ends.end()) return;
  throw InputError(
      {file.string(), lines.empty() ? 0 : lines.back().where.line}, fmt::format("{} numbers", lines.size()),
      "4, 7, 12, 15, 16 or 28 numbers, one a line: oversize, efficiency, f_SL, g / flow azimuth, "
      "k1, k2 / 5 of hole ice / 3 of absorption anisotropy / scaling of its old form / "
      "12 of birefringence");
}

}  // namespace

IceConfiguration read_configuration(const std::filesystem::path& file) {
  const auto lines = read_text_lines(file);
  expect_whole_blocks(file, lines);
  Numbers numbers(lines);
  IceConfiguration result;
  result.oversize = numbers.next(limits::oversize);
  result.module_efficiency = numbers.next(limits::module_efficiency);
  result.simplified_liu_fraction = numbers.next(limits::simplified_liu_fraction);
  result.mean_cosine = numbers.next(limits::mean_cosine);
  if (numbers.holds(7)) {
    result.flow_azimuth_deg = numbers.next(limits::flow_azimuth_deg);
    result.k1 = numbers.next(limits::anisotropy);
    result.k2 = numbers.next(limits::anisotropy);
  }
  if (numbers.holds(12)) result.hole_ice = read_hole_ice(numbers);
  if (numbers.holds(15)) {
    const double k1 = numbers.next(limits::anisotropy), k2 = numbers.next(limits::anisotropy);
    result.absorption_anisotropy = {k1, k2, numbers.next(limits::anisotropy)};
  }
  if (numbers.holds(16)) result.old_absorption_scaling = numbers.next(limits::old_absorption_scaling);
  if (numbers.holds(28)) {
    BirefringenceNumbers birefringence;
    birefringence.sigma_x = read_function(numbers);
    birefringence.sigma_y = read_function(numbers);
    birefringence.mean_x = read_function(numbers);
    result.birefringence = birefringence;
  }
  return result;
}

}  // namespace floe::ice_files
