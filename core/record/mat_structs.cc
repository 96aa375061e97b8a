#include "core/record/mat_structs.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/errors.h"
#include "core/record/time_base.h"

namespace ambrig::mat {

namespace {

using CheckStruct = std::function<void(const matvar_t&, const std::string&)>;

bool IsArray(const matvar_t* v) { return v != nullptr && IsNumeric(*v) && Elements(*v) > 0; }

constexpr std::size_t kMostSignals = 1 << 16;  // of one struct; a damaged size asks for millions

/// How many structs an array holds.
std::size_t StructElements(const matvar_t& v, const std::string& of) {
  const std::size_t fields = FieldNames(v).size();
  const std::size_t count = fields == 0 ? 0 : v.nbytes / sizeof(matvar_t*) / fields;
  if (count > kMostSignals)
    throw InputError(of + " has " + std::to_string(count) + " elements, allowed: up to " +
                     std::to_string(kMostSignals));
  return count;
}

std::string TextOfVariable(const matvar_t* v) { return v == nullptr ? "" : Text(*v); }

/// "Model Root"/"AMB"/"x" -> x
std::string LastPartOfPath(const std::string& path) {
  std::string text;
  for (const char c : path)
    if (c != '"') text += c;
  const std::size_t bar = text.rfind('/');
  return bar == std::string::npos || bar + 1 == text.size() ? text : text.substr(bar + 1);
}

/// The last parts of paths where these tell all apart, else the paths.
std::vector<std::string> ShortNames(const std::vector<std::string>& paths) {
  std::vector<std::string> names;
  for (const std::string& path : paths) names.push_back(LastPartOfPath(path));
  const std::set<std::string> apart(names.begin(), names.end());
  return apart.size() == names.size() && !apart.contains("") ? names : paths;
}

std::vector<double> Samples(const matvar_t& v, const std::string& name, const CheckStruct& check) {
  check(v, name);
  return Numbers(v, static_cast<std::size_t>(Elements(v)));
}

/// Columns of values(rows x n), values(n x rows) with one row, or values(1 x 1 x rows).
std::vector<std::vector<double>> Columns(const matvar_t& v, std::size_t rows,
                                         const std::string& name, const CheckStruct& check) {
  const std::vector<double> all = Samples(v, name, check);
  std::vector<std::vector<double>> out;
  if (rows == 0 || all.size() % rows != 0) return out;
  const std::size_t n = all.size() / rows;
  const bool time_first = v.rank == 2 && v.dims[0] == rows;
  const bool time_last = v.dims[v.rank - 1] == rows;
  if (!time_first && !time_last) return out;
  for (std::size_t c = 0; c < n; ++c) {
    std::vector<double> column(rows);
    for (std::size_t k = 0; k < rows; ++k)
      column[k] = time_first ? all[c * rows + k] : all[k * n + c];
    out.push_back(std::move(column));
  }
  return out;
}

/// Signals of one block on its times, named NAME or NAME(1), NAME(2) ...
void AddColumns(TimedStruct& out, const matvar_t& values, const std::string& name,
                const std::string& unit, const TimeBase& base, std::size_t rows,
                const CheckStruct& check) {
  const auto columns = Columns(values, rows, name, check);
  if (columns.empty())
    out.notes.push_back(name + " has no " + std::to_string(rows) + " rows as its time, left out");
  for (std::size_t c = 0; c < columns.size(); ++c)
    out.channels.push_back(
        {{columns.size() == 1 ? name : name + '(' + std::to_string(c + 1) + ')', unit, columns[c]},
         base.rate,
         base.start});
}

std::optional<TimedStruct> ReadDspace(const matvar_t& v, const std::string& name,
                                      const std::string& path, const CheckStruct& check) {
  const matvar_t *x = FieldOf(v, "X"), *y = FieldOf(v, "Y");
  if (x == nullptr || y == nullptr || x->class_type != MAT_C_STRUCT ||
      y->class_type != MAT_C_STRUCT || !IsArray(FieldOf(*x, "Data")))
    return std::nullopt;
  TimedStruct out;
  const std::size_t signals = StructElements(*y, path + ": " + name + ".Y");
  std::vector<std::string> paths;
  for (std::size_t k = 0; k < signals; ++k) paths.push_back(TextOfVariable(FieldOf(*y, "Name", k)));
  const std::vector<std::string> names = ShortNames(paths);
  for (std::size_t k = 0; k < signals; ++k) {
    const std::string of = names[k].empty() ? name + ".Y(" + std::to_string(k + 1) + ')' : names[k];
    const matvar_t *data = FieldOf(*y, "Data", k), *index = FieldOf(*y, "XIndex", k);
    std::size_t axis = 0;
    if (IsArray(index)) {
      const double number = Samples(*index, of, check).front();
      if (number >= 1 &&
          number <= static_cast<double>(StructElements(*x, path + ": " + name + ".X")))
        axis = static_cast<std::size_t>(number) - 1;
    }
    const matvar_t* time = FieldOf(*x, "Data", axis);
    if (!IsArray(data) || !IsArray(time)) {
      out.notes.push_back(of + " is not a vector of numbers with a time, left out");
      continue;
    }
    const std::vector<double> t = Samples(*time, name + ".X", check);
    const TimeBase base = UniformTimeBase(t, path + ": " + name + ".X.Data");
    AddColumns(out, *data, of, TextOfVariable(FieldOf(*y, "Unit", k)), base, t.size(), check);
  }
  return out;
}

std::optional<TimedStruct> ReadSimulink(const matvar_t& v, const std::string& name,
                                        const std::string& path, const CheckStruct& check) {
  const matvar_t *time = FieldOf(v, "time"), *signals = FieldOf(v, "signals");
  if (!IsArray(time) || signals == nullptr || signals->class_type != MAT_C_STRUCT)
    return std::nullopt;
  TimedStruct out;
  const std::vector<double> t = Samples(*time, name + ".time", check);
  const TimeBase base = UniformTimeBase(t, path + ": " + name + ".time");
  const std::size_t count = StructElements(*signals, path + ": " + name + ".signals");
  for (std::size_t k = 0; k < count; ++k) {
    std::string of = TextOfVariable(FieldOf(*signals, "label", k));
    if (of.empty()) of = count == 1 ? name : name + ".signals(" + std::to_string(k + 1) + ')';
    const matvar_t* values = FieldOf(*signals, "values", k);
    if (IsArray(values))
      AddColumns(out, *values, of, "", base, t.size(), check);
    else
      out.notes.push_back(of + " is not an array of numbers, left out");
  }
  return out;
}

std::optional<TimedStruct> ReadTimeseries(const matvar_t& v, const std::string& name,
                                          const std::string& path, const CheckStruct& check) {
  const matvar_t *time = FieldOf(v, "Time"), *data = FieldOf(v, "Data");
  if (!IsArray(time) || !IsArray(data)) return std::nullopt;
  TimedStruct out;
  const std::vector<double> t = Samples(*time, name + ".Time", check);
  const TimeBase base = UniformTimeBase(t, path + ": " + name + ".Time");
  AddColumns(out, *data, name, TextOfVariable(FieldOf(v, "Unit")), base, t.size(), check);
  return out;
}

}  // namespace

std::optional<TimedStruct> ReadTimedStruct(const matvar_t& v, const std::string& name,
                                           const std::string& path, const CheckStruct& check) {
  for (const auto read : {ReadDspace, ReadSimulink, ReadTimeseries})
    if (auto out = read(v, name, path, check)) return out;
  return std::nullopt;
}

bool IsObject(const matvar_t& v) {
  return v.class_type == MAT_C_OPAQUE || v.class_type == MAT_C_OBJECT ||
         v.class_type == MAT_C_FUNCTION;
}

std::string ObjectText(const std::string& name) {
  return name +
         " is an object of MATLAB (timeseries, table ...), which cannot be read outside it; save "
         "s.Time = ts.Time; s.Data = ts.Data instead, or log in the format 'Structure With Time'";
}

}  // namespace ambrig::mat
