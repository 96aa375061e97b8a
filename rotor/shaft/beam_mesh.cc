#include "rotor/shaft/beam_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/base/counted.h"
#include "rotor/shaft/three_node_element.h"

namespace ambrig {
namespace {

// Planes nearer than this part of the shaft's length are one node.
constexpr double kMergeFraction = 1e-7;

struct Span {
  double lo = std::numeric_limits<double>::max(), hi = std::numeric_limits<double>::lowest();
  double tolerance() const { return kMergeFraction * (hi - lo); }
};

Span ShaftSpan(const BeamDefinition& d) {
  Span span;
  for (const ShaftSection& s : d.sections) {
    const std::string problem = SectionProblem(s);
    if (!problem.empty())
      throw InputError(fmt::format("shaft section \"{}\": {}", s.name, problem));
    if (!s.stiff) continue;
    span.lo = std::min(span.lo, s.z0);
    span.hi = std::max(span.hi, s.z0 + s.length);
  }
  if (span.hi <= span.lo) throw InputError("beam rotor: no shaft section, allowed: at least one");
  return span;
}

void RequireOnShaft(const Span& span, double z, const std::string& what) {
  if (z < span.lo - span.tolerance() || z > span.hi + span.tolerance())
    throw InputError(fmt::format("{} at z = {} m is off the shaft, allowed {} to {} m", what,
                                 NumberText(z), NumberText(span.lo), NumberText(span.hi)));
}

std::vector<double> Planes(const BeamDefinition& d, const Span& span) {
  std::vector<double> z;
  const std::size_t most =
      d.theory.element == ElementKind::kThreeNode ? kMostElements / 2 : kMostElements;
  // Given planes first: where an even split falls on one of them, the given value stays.
  const auto add = [&](double plane, const std::string& what) {
    RequireOnShaft(span, plane, what);
    for (double other : z)
      if (std::abs(other - plane) <= span.tolerance()) return;
    z.push_back(plane);
    if (z.size() > most + 1)
      throw InputError(fmt::format(
          "the shaft has more than {} elements (elements_per_section = {}, {}), allowed: at most "
          "{}, whose modes take minutes; 4 per section suffice for most shafts",
          most, d.elements_per_section, Counted(d.sections.size(), "section"), most));
  };
  for (const Disk& disk : d.disks) add(disk.z, fmt::format("disk \"{}\"", disk.name));
  for (const SpringSupport& s : d.supports) {
    if (s.on_shaft()) add(s.z, fmt::format("support \"{}\"", s.name));
    if (s.between_shafts()) add(s.to_z, fmt::format("support \"{}\"", s.name));
  }
  for (const PointMass& m : d.masses) add(m.z, fmt::format("mass \"{}\"", m.name));
  for (double station : d.stations) add(station, "station");
  for (const ShaftSection& s : d.sections) {
    const int n = s.stiff ? d.elements_per_section : 1;
    for (int k = 0; k <= n; ++k)
      add(s.z0 + s.length * k / n, fmt::format("section \"{}\"", s.name));
  }
  std::sort(z.begin(), z.end());
  return z;
}

ShaftElement MakeElement(const BeamDefinition& d, double left, double right, double tolerance) {
  ShaftElement e{left, right - left, {}};
  bool carried = false;
  for (const ShaftSection& s : d.sections) {
    if (s.z0 > left + tolerance || s.z0 + s.length < right - tolerance) continue;
    e.layers.push_back(Slice(s, left, right));
    carried |= s.stiff;
  }
  for (const PlacedShaft& s : d.shafts)  // a gap between two shafts
    if (std::abs(s.start - right) <= tolerance && e.layers.empty()) return e;
  if (!carried)
    throw InputError(fmt::format("beam rotor: no shaft section between {} and {}",
                                 PlaceText(d.shafts, left), PlaceText(d.shafts, right)));
  return e;
}

/// A gap between two shafts stays one piece.
BeamMesh WithMiddleNodes(const BeamMesh& mesh) {
  BeamMesh out{{mesh.z[0]}, {}};
  for (std::size_t i = 0; i < mesh.elements.size(); ++i) {
    if (mesh.elements[i].layers.empty()) {
      out.elements.push_back(mesh.elements[i]);
    } else {
      for (const ShaftElement& half : Halves(mesh.elements[i])) out.elements.push_back(half);
      out.z.push_back(out.elements.back().z0);
    }
    out.z.push_back(mesh.z[i + 1]);
  }
  return out;
}

}  // namespace

std::string SectionProblem(const ShaftSection& s) {
  if (!(s.length > 0)) return fmt::format("length = {} m, allowed above 0", NumberText(s.length));
  if (!(s.id >= 0 && s.id < s.od))
    return fmt::format("id = {} m, allowed 0 to below od = {} m", NumberText(s.id),
                       NumberText(s.od));
  if (!(s.id_right >= 0 && s.id_right < s.od_right))
    return fmt::format("id_right = {} m, allowed 0 to below od_right = {} m",
                       NumberText(s.id_right), NumberText(s.od_right));
  if (s.stiff && !(s.material.E > 0)) return "E is not positive";
  return {};
}

BeamMesh MakeMesh(const BeamDefinition& d) {
  if (d.elements_per_section < 1)
    throw InputError(
        fmt::format("elements_per_section = {}, allowed 1 or more", d.elements_per_section));
  const Span span = ShaftSpan(d);
  BeamMesh mesh{Planes(d, span), {}};
  for (std::size_t i = 0; i + 1 < mesh.z.size(); ++i)
    mesh.elements.push_back(MakeElement(d, mesh.z[i], mesh.z[i + 1], span.tolerance()));
  return d.theory.element == ElementKind::kThreeNode ? WithMiddleNodes(mesh) : mesh;
}

}  // namespace ambrig
