// What the ingredients of a scatter cost on this machine when all lanes take them together: loops over 64
// lanes that hold one ingredient each, compiled as the engine is. A scatter can cost no less than the
// ingredients that it needs.
#pragma once

#include <cstdint>

#include "propagation/engine/table_rows.h"

namespace floe::vector_costs {

inline constexpr int lanes = 64;
inline constexpr int table_size = 512;

// Arguments and results of one loop; all of it stays in the first-level cache.
struct alignas(64) Data {
  float in[lanes], out[lanes];
  std::uint32_t random0[lanes], random1[lanes], random2[lanes], random3[lanes];
  std::int32_t index[lanes];
  float table[table_size];
  TableRow rows[table_size];
  float columns[8][lanes];
};
// Values in (0, 1), indices all over the table.
void fill(Data& data);

void random_numbers(Data& data);
void logarithms(Data& data);
void exponentials(Data& data);
void sines_and_cosines(Data& data);  // of one angle, both
void square_roots(Data& data);
void divisions(Data& data);
void table_lookups(Data& data);
void table_rows(Data& data);        // eight numbers at one place
void loads_and_stores(Data& data);  // one of each

}  // namespace floe::vector_costs
