/// kind = "tilt-translation": the rotor's translation and tilt, each with gains of its own.
#include <fmt/format.h>

#include "control/kinds/read_system.h"
#include "control/position/tilt_translation.h"

namespace ambrig {

namespace {

CoordinateGains ReadGains(const TomlTable& t, const char* key,
                          const Field<CoordinateGains> (&fields)[4]) {
  const auto inner = t.Table(key);
  if (!inner)
    t.Fail(key, "is missing, allowed: { kp = , kd = , ki = , derivative_time_constant = }");
  CoordinateGains g;
  inner->Read(g, fields);
  inner->RejectUnknownKeys();
  return g;
}

void ReadTiltTranslation(const TomlTable& t, const ControllerNames&, ControllerParameters& c) {
  c.translation = ReadGains(t, "translation", kTranslationFields);
  c.tilt = ReadGains(t, "tilt", kTiltFields);
  t.Read(c, kTiltTranslationFields);
}

std::unique_ptr<PositionController> MakeTiltTranslation(const ControllerParameters& c,
                                                        const ControllerSite& site) {
  TiltTranslationGeometry g;
  g.inertia_polar = site.inertia_polar;
  for (const ControllerSite::Bearing& b : site.bearings) {
    if (!b.radial)
      throw InputError(
          fmt::format("{}: kind = \"tilt-translation\", but bearing {} is not radial; allowed: its "
                      "own controller, "
                      "[bearings.{}.controller]",
                      c.where, b.name, b.name));
    g.sensor_z.push_back(b.sensor_z);
    g.bearing_z.push_back(b.z);
  }
  if (g.sensor_z.size() < 2)
    throw InputError(
        fmt::format("{}: kind = \"tilt-translation\", allowed: with two radial bearings or more "
                    "that it controls",
                    c.where));
  return std::make_unique<TiltTranslation>(c.translation, c.tilt, c.gyroscopic_compensation, g,
                                           site.f_max, site.period);
}

void DocumentTiltTranslation(std::vector<ParameterRow>& rows) {
  AddRows(rows, "[controller] kind = \"tilt-translation\"", kTiltTranslationFields);
  AddRows(rows, "[controller] kind = \"tilt-translation\", translation", kTranslationFields);
  AddRows(rows, "[controller] kind = \"tilt-translation\", tilt", kTiltFields);
}

}  // namespace

const ControllerKind& TiltTranslationKind() {
  static constexpr ControllerKind kind{
      .name = "tilt-translation",
      .doc = "translation and tilt of the rotor",
      .read = ReadTiltTranslation,
      .make = MakeTiltTranslation,
      .document = DocumentTiltTranslation,
  };
  return kind;
}

}  // namespace ambrig
