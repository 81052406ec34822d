// Where a module's arrival times are cut into bins: Bayesian blocks (Scargle et al. 2013,
// arXiv:1207.5578) over a fine regular binning.
#pragma once

#include <span>
#include <vector>

namespace floe {

// Counts in cells of equal width, in order. Returns the first cell of every block but the first, rising:
// the piecewise constant rate of largest fitness sum_blocks N (ln N - ln T) less a prior of
//   4 - ln(73.53 p N_cells^-0.478)          (arXiv:1207.5578, eqs. 19 and 21)
// a block, with p the chance of a false cut. No cuts for fewer than two counts. Cuts are tried where
// the counts change from or to zero, and between cells with counts; that is where optimal ones lie.
// Needs counts >= 0 and 0 < p < 1. Time goes with the square of the cells that hold counts.
std::vector<std::size_t> bayesian_blocks(std::span<const double> counts, double false_cut = 0.05);

// Width of the cells that blocks of arrival times are made of [ns].
inline constexpr double block_cell = 25;

// Inner bin edges [ns], rising, of one module: its blocks over cells of `cell` ns aligned to multiples of
// `cell`, over [begin, end]. The first bin reaches back to -infinity and the last to infinity, so that
// light where there are no data counts too. Times outside [begin, end] are counted in the outermost
// cells. `times` and `charges` are of equal length.
std::vector<double> block_edges(std::span<const double> times, std::span<const double> charges, double begin,
                                double end, double cell = block_cell);

}  // namespace floe
