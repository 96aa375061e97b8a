// Numbers of a shaft as things to calibrate: { value, sd, fitted } of materials, sections, disks
// and damping.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/read_file.h"
#include "discovery/decision/compare.h"
#include "discovery/refine/adopt.h"
#include "discovery/search/fit.h"
#include "rig/rig_assembly.h"
#include "rotor/shaft/shaft_parameters.h"
#include "simulation/switching/switching_engine.h"
#include "tests/simulation/tum_rig.h"

namespace ambrig {
namespace {

using testing::kTumFolder;
using testing::Replaced;
using testing::TumRig;
using testing::TumRigText;

void ExpectSameRotor(const RigParameters& a, const RigParameters& b, const std::string& what) {
  EXPECT_NEAR(a.rotor.mass / b.rotor.mass, 1, 1e-12) << what;
  EXPECT_NEAR(a.rotor.inertia_transverse / b.rotor.inertia_transverse, 1, 1e-12) << what;
  EXPECT_NEAR(a.rotor.inertia_polar / b.rotor.inertia_polar, 1, 1e-12) << what;
  EXPECT_NEAR(a.z_origin, b.z_origin, 1e-14) << what;
  for (std::size_t k = 0; k < 4; ++k) {  // adopted text holds nine digits
    EXPECT_NEAR(a.modes[k].omega / b.modes[k].omega, 1, 1e-8) << what;
    EXPECT_NEAR(a.modes[k].damping / b.modes[k].damping, 1, 1e-8) << what;
  }
  for (std::size_t k = 0; k < a.bearings.size(); ++k) {
    EXPECT_NEAR(a.bearings[k].z, b.bearings[k].z, 1e-14) << what;
    EXPECT_NEAR(a.bearings[k].sensor.z, b.bearings[k].sensor.z, 1e-14) << what;
  }
  for (std::size_t k = 0; k < a.stations.size(); ++k)
    EXPECT_NEAR(a.stations[k].z, b.stations[k].z, 1e-14) << what;
}

struct Number {
  const char *line, *fitted, *plain, *path;
  double value;
};

constexpr const char* kSecond = "length = 0.038\nod = 0.0096";
const Number kNumbers[] = {
    {"E = 2.11e11", "E = { value = 2.11e11, sd = 4e9, fitted = 2.05e11 }", "E = 2.05e11",
     "rotor.materials.shaft_steel.E", 2.05e11},
    {"rho = 7860.0", "rho = { value = 7860.0, sd = 50.0, fitted = 7800.0 }", "rho = 7800.0",
     "rotor.materials.shaft_steel.rho", 7800},
    {kSecond, "length = 0.038\nod = { value = 0.0096, sd = 1e-4, fitted = 0.0099 }",
     "length = 0.038\nod = 0.0099", "rotor.section[2].od", 0.0099},
    {"mass = 1.276499", "mass = { value = 1.276499, sd = 0.01, fitted = 1.3 }", "mass = 1.3",
     "rotor.disk[2].mass", 1.3},
    // moves the centre
    {"mass = 0.85074", "mass = { value = 0.85074, sd = 0.01, fitted = 0.9 }", "mass = 0.9",
     "rotor.disk[1].mass", 0.9},
    {"modal_damping = 0.002", "modal_damping = { value = 0.002, sd = 5e-4, fitted = 0.003 }",
     "modal_damping = 0.003", "rotor.modal_damping", 0.003},
};

// A fitted number is the same rig as one drawn with it.
TEST(ShaftCalibration, FittedNumbersAreTheTruth) {
  const RigParameters drawn = TumRig(TumRigText());
  for (const Number& n : kNumbers) {
    const RigParameters rig = TumRig(TumRigText({{n.line, n.fitted}}));
    ExpectSameRotor(rig, drawn, n.path);  // the controller's
    ASSERT_EQ(rig.tolerances.size(), 1u);
    EXPECT_EQ(rig.tolerances[0].path, n.path);
    const RigParameters truth = *TrueRig(rig);
    ExpectSameRotor(truth, TumRig(TumRigText({{n.line, n.plain}})), n.path);
    EXPECT_EQ(*ParameterAt(truth, n.path), n.value);
    EXPECT_GT(std::abs(truth.rotor.mass / drawn.rotor.mass - 1) +
                  std::abs(truth.modes[0].omega / drawn.modes[0].omega - 1) +
                  std::abs(truth.modes[0].damping / drawn.modes[0].damping - 1),
              1e-4)
        << n.path;
    double lo = 0, hi = 0;
    std::string unit;
    EXPECT_TRUE(ParameterRange(rig, n.path, &lo, &hi, &unit));
    EXPECT_LT(lo, n.value);
    EXPECT_GT(hi, n.value);
  }
}

// A sensor's plane with an sd beside a disk's mass that moves the centre of mass: in any order the
// same.
TEST(ShaftCalibration, PlanesStayOnTheShaft) {
  const RigParameters rig =
      TumRig(TumRigText({{"mass = 0.85074", "mass = { value = 0.85074, sd = 0.01 }"},
                         {"sensor = { z = 0.623", "sensor = { z = { value = 0.623, sd = 1e-3 }"}}));
  const double moved = *ParameterAt(rig, "bearings.B.sensor.z") + 5e-4;
  RigParameters a = rig, b = rig;
  EXPECT_TRUE(SetParameter(a, "rotor.disk[1].mass", 0.95));
  EXPECT_TRUE(SetParameter(a, "bearings.B.sensor.z", moved));
  EXPECT_TRUE(SetParameter(b, "bearings.B.sensor.z", moved));
  EXPECT_TRUE(SetParameter(b, "rotor.disk[1].mass", 0.95));
  ExpectSameRotor(a, b, "order");
  EXPECT_GT(std::abs(a.z_origin - rig.z_origin), 1e-3);
  EXPECT_NEAR(a.bearings[1].sensor.z + a.z_origin, 0.6235, 1e-12);
  EXPECT_NEAR(a.bearings[1].z + a.z_origin, 0.623, 1e-12);
  EXPECT_FALSE(SetParameter(a, "rotor.disk[2].mass", 1.0));  // has no sd
}

// Geometry: a disk of steel is as heavy as its steel, a tube's wall follows its outer diameter at
// both ends.
TEST(ShaftCalibration, WhatDependsOnANumberFollowsIt) {
  const std::string tail =
      "\n[rotor.materials.m]\nE = 2e11\nrho = { value = 8000.0, sd = 10.0 }\n"
      "[[rotor.section]]\nlength = 0.3\nod = { value = 0.02, sd = 1e-4 }\nid = 0.01\nmaterial = "
      "\"m\"\n"
      "[[rotor.sleeve]]\nz0 = 0.1\nlength = 0.05\nid = 0.02\nod = 0.03\nmaterial = \"m\"\nrho = "
      "7000.0\n"
      "[[rotor.disk]]\nz = 0.2\nwidth = 0.01\nod = 0.1\nid = 0.02\nmaterial = \"m\"\n";
  std::vector<Tolerance> tolerances;
  BeamFile beam =
      ReadBeam(*TomlTable::FromText("[rotor]\nkind = \"beam\"\nmodes = 1\n" + tail, "rig.toml")
                    .Table("rotor"),
               &tolerances);
  ASSERT_EQ(beam.parameters.size(), 2u);
  const Disk before = beam.definition.disks[0];
  for (std::size_t k = 0; k < 2; ++k)
    SetShaftParameter(beam, k, beam.parameters[k].path == "rotor.materials.m.rho" ? 8800 : 0.022);
  EXPECT_NEAR(beam.definition.disks[0].mass, 1.1 * before.mass, 1e-12);
  EXPECT_NEAR(beam.definition.disks[0].inertia_polar, 1.1 * before.inertia_polar, 1e-15);
  EXPECT_EQ(beam.definition.sections[0].material.rho, 8800);
  EXPECT_EQ(beam.definition.sections[1].material.rho, 7000);  // its own
  EXPECT_EQ(beam.definition.sections[0].od, 0.022);
  EXPECT_EQ(beam.definition.sections[0].od_right, 0.022);
  EXPECT_EQ(beam.definition.sections[0].id_right, 0.01);
}

TEST(ShaftCalibration, WhatCannotBeMovedIsToldInOneLine) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"length = 0.094", "length = { value = 0.094, sd = 1e-3 }"},
      {"z = 0.363", "z = { value = 0.363, sd = 1e-3 }"}};
  for (const auto& [from, to] : mistakes) {
    try {
      TumRig(TumRigText({{from, to}}));
      ADD_FAILURE() << to;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("has an sd, allowed: diameters"), std::string::npos)
          << e.what();
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    }
  }
}

/// What a logger would have: the truth's run, noise and all.
CaseRecord MeasuredWith(const RigParameters& rig, const RigParameters& truth) {
  CaseRecord r;
  r.scenario = ReadScenarioText(
      "duration = 0.6\nrecord_rate = 2500.0\nseed = 11\n[[excitation]]\ntarget = \"A.x\"\nport = "
      "\"force\"\n"
      "kind = \"chirp\"\namplitude = 3.0\nf0 = 8.0\nf1 = 240.0\n",
      kTumFolder + "chirp.toml", rig);
  EngineOptions options;
  const NominalRig nominal(rig);
  options.nominal = &nominal;
  const Record whole = SwitchingEngine(truth, r.scenario, options).Run().record;
  r.data.rate = whole.rate;
  for (const char* name : {"A.x", "A.y", "B.x", "B.y", "A.i1", "A.i5", "B.i1", "B.i5"}) {
    r.data.channels.push_back(*whole.Find(name));
    r.quality.push_back(InspectChannel(r.data.channels.back(), false));
  }
  return r;
}

// The measured rig's shaft is 3 % softer and its modes twice as well damped: a fit says so.
TEST(ShaftCalibration, AFitFindsTheShaft) {
  const RigParameters rig = TumRig(
      TumRigText({{"E = 2.11e11", "E = { value = 2.11e11, sd = 4e9 }"},
                  {"modal_damping = 0.002", "modal_damping = { value = 0.002, sd = 1e-3 }"}}));
  RigParameters truth = rig;
  SetParameter(truth, "rotor.materials.shaft_steel.E", 2.047e11);
  SetParameter(truth, "rotor.modal_damping", 0.004);
  Case c;
  c.rig = rig;
  c.records.push_back(MeasuredWith(rig, truth));
  CaseModel model(c);
  const Hypothesis nominal = Hypothesis::Base(rig);
  ASSERT_EQ(nominal.free.size(), 2u);
  const Comparison before = Compare(model, nominal, false);
  EXPECT_GT(before.ratio_fit, 2);
  FitOptions options;
  options.effective_sample_size = before.effective_sample_size;
  const FitResult fit = Fit(model, nominal, options);
  EXPECT_LT(fit.ratio_fit, 1.2);
  for (std::size_t k = 0; k < 2; ++k) {
    const bool E = fit.hypothesis.free[k].path == "rotor.materials.shaft_steel.E";
    const double value = fit.hypothesis.free[k].value;
    EXPECT_NEAR(value, E ? 2.047e11 : 0.004, E ? 2e8 : 4e-4);
    EXPECT_LT(std::abs(value - (E ? 2.047e11 : 0.004)), 5 * fit.sd[k]);
  }
  // What is adopted reads back as that shaft.
  const std::string text = AdoptedRigText(
      TumRigText({{"E = 2.11e11", "E = { value = 2.11e11, sd = 4e9 }"},
                  {"modal_damping = 0.002", "modal_damping = { value = 0.002, sd = 1e-3 }"}}),
      fit.hypothesis, {});
  ExpectSameRotor(*TrueRig(TumRig(text)), fit.hypothesis.rig, "adopted");
}

// The k-th table of [[rotor.section]] is the k-th line that is written; of a shaft's own file
// nothing can be.
TEST(ShaftCalibration, AdoptedTextOfTables) {
  const std::string text =
      TumRigText({{kSecond, "length = 0.038\nod = { value = 0.0096, sd = 1e-4 }  # turned"}});
  Hypothesis h = Hypothesis::Base(TumRig(text));
  h.Set(0, 0.0098);
  const std::string adopted = AdoptedRigText(text, h, {});
  EXPECT_NE(adopted.find("od = { value = 0.0096, sd = 1e-4, fitted = 0.0098 }  # turned"),
            std::string::npos);
  EXPECT_NEAR(TrueRig(TumRig(adopted))->beam->definition.sections[1].od, 0.0098, 1e-15);
  EXPECT_THROW(AdoptedRigText(ReadFile(kTumFolder + "rig.toml"), h, {}), InputError);
}

}  // namespace
}  // namespace ambrig
