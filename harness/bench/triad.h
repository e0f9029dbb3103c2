#pragma once
// Memory bandwidth: a_i = b_i + s c_i on arrays that no cache holds (McCalpin's STREAM triad).

namespace ddem::harness::bench {

/// GB/s (1e9 bytes, three a loop: the store's own read is not counted, as STREAM does), the best of several passes.
double triad_gb_per_s(int threads);

}  // namespace ddem::harness::bench
