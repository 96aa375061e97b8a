// Noise of one period: 8 coils x 18 or 45 samples. Target: 1 ns per normal.
#include <benchmark/benchmark.h>

#include "core/math/noise.h"
#include "core/math/noise_dispatch.h"

namespace ambrig {
namespace {

template <class Fill>
void Normals(benchmark::State& state, const Fill& fill) {
  alignas(64) float out[512];
  const int n = static_cast<int>(state.range(0));
  std::uint64_t index = 0;
  for (auto _ : state) {
    fill(++index, out, n);
    benchmark::DoNotOptimize(out[0]);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * n);
}

void ThisMachine(benchmark::State& state) {
  Normals(state, [](std::uint64_t index, float* out, int n) { FillNormals(1, 2, index, out, n); });
}
BENCHMARK(ThisMachine)->Arg(144)->Arg(360);

void Baseline(benchmark::State& state) {
  Normals(state, [](std::uint64_t i, float* out, int n) { FillFromBaseline(1, 2, i, out, n); });
}
BENCHMARK(Baseline)->Arg(144)->Arg(360);

#ifdef __x86_64__
void Avx2(benchmark::State& state) {
  if (!HasAvx2()) return state.SkipWithError("no AVX2");
  Normals(state, [](std::uint64_t i, float* out, int n) { FillFromAvx2(1, 2, i, out, n); });
}
BENCHMARK(Avx2)->Arg(144)->Arg(360);
#endif

void OneNormal(benchmark::State& state) {
  std::uint64_t index = 0;
  for (auto _ : state) benchmark::DoNotOptimize(Normal(1, 2, ++index));
}
BENCHMARK(OneNormal);

}  // namespace
}  // namespace ambrig
