/// Shafts in files of their own: ours as text and back, through ROSS's file and back.
#include "rotor/shaft/shaft_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "rotor/shaft/ross_file.h"

namespace ambrig {
namespace {

const std::string kShaft = std::string(AMBRIG_SOURCE_DIR) + "/examples/tum_mbtr/shaft.toml";

/// A file of this test's own, gone afterwards.
struct TemporaryShaft {
  explicit TemporaryShaft(const std::string& ending)
      : path((std::filesystem::temp_directory_path() /
              ("shaft_" + std::to_string(getpid()) + ending))
                 .string()) {}
  ~TemporaryShaft() { std::filesystem::remove(path); }
  std::string path;
};

BeamFile Read(const std::string& file, bool from_ross) {
  bool ross = !from_ross;
  std::vector<std::string> ignored;
  const BeamFile out = ReadShaft(file, &ross, &ignored);
  EXPECT_EQ(ross, from_ross);
  EXPECT_TRUE(ignored.empty());
  return out;
}

TEST(ShaftFile, TextReadsBackToTheSameNumbers) {
  BeamFile before = Read(kShaft, false);
  before.definition.theory.shear = false;
  before.definition.theory.mass = MassKind::kLumped;
  before.definition.sections[2].od_right = 0.0093;
  before.definition.sections[1].id = before.definition.sections[1].id_right = 0.001;
  ShaftSection sleeve = before.definition.sections[1];
  sleeve.stiff = false, sleeve.id = sleeve.id_right = 0.0096, sleeve.od = sleeve.od_right = 0.02;
  before.definition.sections.push_back(sleeve);
  before.planes.push_back({"probe", 0.2});
  before.definition.stations.push_back(0.2);
  before.modal_damping = {0.001, 0.002, 0.003, 0.004};
  const TemporaryShaft file(".toml");
  WriteBeam(before, file.path);
  const BeamFile after = Read(file.path, false);
  const BeamRotor a = BuildBeam(before.definition), b = BuildBeam(after.definition);
  EXPECT_EQ((a.M - b.M).norm(), 0);
  EXPECT_EQ((a.K - b.K).norm(), 0);
  EXPECT_EQ((a.C - b.C).norm(), 0);
  EXPECT_EQ((a.J - b.J).norm(), 0);
  EXPECT_EQ(after.modes, before.modes);
  EXPECT_EQ(after.modal_damping, before.modal_damping);
  ASSERT_EQ(after.planes.size(), 4u);
  EXPECT_EQ(after.planes[1].name, "disk");
  EXPECT_EQ(after.planes[3].name, "probe");
}

TEST(ShaftFile, ThroughRossAndBack) {
  const BeamFile before = Read(kShaft, false);
  for (const char* ending : {".json", ".toml"}) {
    const TemporaryShaft ross(ending);
    WriteRoss(before.definition, ross.path);
    const BeamFile there = Read(ross.path, true);
    const TemporaryShaft ours(".back.toml");
    WriteBeam(there, ours.path);
    const ReducedRotor a = Reduce(BuildBeam(before.definition), 4, {0.0});
    const ReducedRotor b = Reduce(BuildBeam(Read(ours.path, false).definition), 4, {0.0});
    EXPECT_NEAR(b.mass / a.mass, 1, 1e-13);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(b.omega[k] / a.omega[k], 1, 1e-9) << ending;
    ASSERT_EQ(there.planes.size(), 3u);
    EXPECT_EQ(there.planes[1].name, "disk");
  }
}

TEST(ShaftFile, NoShaftIsOneLine) {
  bool ross = false;
  std::vector<std::string> ignored;
  for (const char* file : {"/nowhere/rotor.json", "/nowhere/rotor.toml", "rotor.txt"})
    EXPECT_THROW(ReadShaft(file, &ross, &ignored), InputError);
  BeamFile shaft = Read(kShaft, false);
  EXPECT_THROW(WriteBeam(shaft, "/nowhere/shaft.toml"), InputError);
  EXPECT_THROW(WriteRoss(shaft.definition, "/nowhere/shaft.json"), InputError);
}

}  // namespace
}  // namespace ambrig
