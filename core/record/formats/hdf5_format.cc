/// HDF5: datasets as channels.
#include "core/record/formats/format.h"
#include "core/record/hdf5.h"

namespace ambrig {

RecordFormat Hdf5Format() {
  return {"HDF5", ".h5 .hdf5",
          [](std::string_view begin) { return begin.starts_with("\x89HDF\r\n\x1a\n"); },
          [](const std::string& path) {
            return Measurement{ReadHdf5(path), {}};
          }};
}

}  // namespace ambrig
