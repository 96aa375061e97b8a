/// kind = "pid": one PID per axis, with filters and gains over the speed where the file has them.
#include <algorithm>

#include "control/kinds/read_system.h"
#include "control/position/filtered_pid.h"

namespace ambrig {

namespace {

void ReadPid(const TomlTable& t, const ControllerNames& names, ControllerParameters& c) {
  t.Read(c.pid, kPidFields);
  for (const TomlTable& f : t.Tables("filter"))
    c.filters.push_back(ReadFilter(f, names.axes, c.rate));
  double before = -1;
  for (const TomlTable& s : t.Tables("schedule")) {
    PidPoint p{kRequired, c.pid.kp, c.pid.kd, c.pid.ki};
    s.Read(p, kPidPointFields);
    CheckAscending(s, before, p.speed);
    before = p.speed;
    s.RejectUnknownKeys();
    c.schedule.push_back(p);
  }
}

PidSchedule ScheduleOf(const ControllerParameters& c) {
  PidSchedule s{{0}, {c.pid}};
  if (c.schedule.empty()) return s;
  s.speeds.clear();
  s.points.clear();
  for (const PidPoint& point : c.schedule) {
    PidParameters p = c.pid;
    p.kp = point.kp;
    p.kd = point.kd;
    p.ki = point.ki;
    s.speeds.push_back(point.speed);
    s.points.push_back(p);
  }
  return s;
}

std::unique_ptr<PositionController> MakePid(const ControllerParameters& c,
                                            const ControllerSite& site) {
  if (c.filters.empty() && c.schedule.empty())
    return std::make_unique<DecentralisedPid>(std::vector<PidParameters>(site.axes.size(), c.pid),
                                              site.period);
  std::vector<FilteredPidAxis> axes;
  for (const std::string& name : site.axes) {
    FilteredPidAxis axis{ScheduleOf(c), {}};
    for (const FilterParameters& f : c.filters)
      if (f.axes.empty() || std::find(f.axes.begin(), f.axes.end(), name) != f.axes.end())
        axis.filters.push_back(SampleFilter(f, site.period));
    axes.push_back(axis);
  }
  return std::make_unique<FilteredPid>(std::move(axes), site.period);
}

void DocumentPid(std::vector<ParameterRow>& rows) {
  AddRows(rows, "[controller]", kPidFields);
  AddRows(rows, "[[controller.schedule]]", kPidPointFields);
  AddRows(rows, "[[controller.filter]] kind = \"notch\"", kNotchFields);
  AddRows(rows, "[[controller.filter]] kind = \"lead-lag\"", kLeadLagFields);
  AddRows(rows, "[[controller.filter]] kind = \"low-pass\"", kLowPassFields);
}

}  // namespace

const ControllerKind& PidKind() {
  static constexpr ControllerKind kind{
      .name = "pid",
      .doc = "one PID per axis",
      .read = ReadPid,
      .make = MakePid,
      .document = DocumentPid,
      .per_axis = true,
  };
  return kind;
}

}  // namespace ambrig
