// [controller] of a rig file, and the files of matrices that it may name.
#include "control/interface/controller_file.h"
#include "tests/fuzz/fuzz_input.h"

using namespace ambrig;  // NOLINT: a program of one function

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::TakesOrRefuses([&] {
    // A state space may name the input itself as the file of its matrices.
    const TomlTable table = TomlTable::FromFile(fuzz::FileOf(data, size, ".toml"));
    ControllerParameters c;
    table.Read(c, kControllerFields);
    ReadControllerKind(table, {"A.x", "A.y", "B.x", "B.y"}, {"A", "B", "disk"}, c);
    table.RejectUnknownKeys();
  });
}
