#pragma once
/// The reference rig without its thrust bearing, and the records of an examination in which it is
/// clamped: a case of these takes a second.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/read_file.h"
#include "core/base/toml_edit.h"
#include "discovery/experiment/examination.h"
#include "rig/rig_file.h"

namespace ambrig::testing {

class ClampedReference : public ::testing::Test {
 protected:
  ClampedReference() {
    const std::string file = std::string(AMBRIG_SOURCE_DIR) + "/examples/reference/rig.toml";
    rig_ = ReadRigText(WithoutTomlTable(ReadFile(file), file, "bearings.Z"), file);
    for (const ExaminationRecord& r : Examination(rig_, 3))
      if (r.title.starts_with("clamped")) records_.push_back(r);
  }

  RigParameters rig_;
  std::vector<ExaminationRecord> records_;
};

}  // namespace ambrig::testing
