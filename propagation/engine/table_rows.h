// Tables that every lane reads at a place of its own. Numbers that are used together lie in one row, which
// is one load; gathering them one by one costs a load each.
#pragma once

#include <cstdint>

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace floe {

struct alignas(32) TableRow {
  float values[8];
};

// columns[k][i] = rows[index[i]].values[k] for i < Count, a multiple of 8.
template <int Count>
[[gnu::always_inline]] inline void fetch_rows(const TableRow* rows, const std::int32_t* index,
                                              float (&columns)[8][Count]) {
  static_assert(Count % 8 == 0);
#ifdef __AVX__
  for (int first = 0; first < Count; first += 8) {
    __m256 row[8], pair[8], four[8];
    for (int k = 0; k < 8; ++k) row[k] = _mm256_load_ps(rows[index[first + k]].values);
    for (int k = 0; k < 8; k += 2) {
      pair[k] = _mm256_unpacklo_ps(row[k], row[k + 1]);
      pair[k + 1] = _mm256_unpackhi_ps(row[k], row[k + 1]);
    }
    for (int k = 0; k < 8; k += 4) {
      four[k] = _mm256_shuffle_ps(pair[k], pair[k + 2], 0x44);
      four[k + 1] = _mm256_shuffle_ps(pair[k], pair[k + 2], 0xee);
      four[k + 2] = _mm256_shuffle_ps(pair[k + 1], pair[k + 3], 0x44);
      four[k + 3] = _mm256_shuffle_ps(pair[k + 1], pair[k + 3], 0xee);
    }
    for (int k = 0; k < 4; ++k) {
      _mm256_storeu_ps(columns[k] + first, _mm256_permute2f128_ps(four[k], four[k + 4], 0x20));
      _mm256_storeu_ps(columns[k + 4] + first, _mm256_permute2f128_ps(four[k], four[k + 4], 0x31));
    }
  }
#else
  for (int i = 0; i < Count; ++i)
    for (int k = 0; k < 8; ++k) columns[k][i] = rows[index[i]].values[k];
#endif
}

}  // namespace floe
