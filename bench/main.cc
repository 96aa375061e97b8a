#include <benchmark/benchmark.h>

#include "core/base/memory_reuse.h"

int main(int argc, char** argv) {
  ambrig::KeepFreedMemory();  // as ambrig does
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
