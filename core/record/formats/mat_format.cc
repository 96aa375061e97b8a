/// MATLAB files. Those of version 7.3 have 512 bytes of their own before the HDF5 signature.
#include "core/record/mat.h"
#include "core/record/formats/format.h"

namespace ambrig {

RecordFormat MatFormat() {
  return {"MAT", ".mat", [](std::string_view begin) { return begin.starts_with("MATLAB "); },
          ReadMatMeasurement};
}

}  // namespace ambrig
