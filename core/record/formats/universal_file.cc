/// Universal Files (.unv, .uff): time responses and frequency responses of
/// their data sets 58 and 58b; other data sets are skipped.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <set>

#include "core/base/errors.h"
#include "core/base/read_file.h"
#include "core/record/formats/format.h"
#include "core/record/formats/universal_function.h"
#include "core/record/text_cells.h"
#include "core/record/time_base.h"
#include "core/record/time_groups.h"

namespace ambrig {

namespace {

constexpr int kTime = 17, kFrequency = 18;  // types of an axis
constexpr int kAbscissaDigits = 6;          // E13.5

bool IsUniversalFile(std::string_view begin) {
  Lines lines(begin);
  while (lines.Next() && Trim(lines.line()).empty()) {
  }
  if (Trim(lines.line()) != "-1" || !lines.Next()) return false;
  const std::string_view set = Trim(lines.line());
  return !set.empty() && set[0] >= '0' && set[0] <= '9';
}

std::vector<UniversalFunction> ReadFunctions(const std::string& path, std::string_view bytes) {
  UniversalText text(path, bytes);
  std::vector<UniversalFunction> functions;
  while (text.Next()) {
    if (!text.AtMark()) continue;
    if (!text.Next()) break;
    const std::string_view set = Trim(text.line());
    if (set == "58" || set.starts_with("58b")) functions.push_back(ReadUniversalFunction(text));
    bool ended = false;
    while (!ended && text.Next()) ended = text.AtMark();
    if (!ended) text.Fail("the data set has no end (a line \"    -1\")");
  }
  return functions;
}

bool OverTime(const UniversalFunction& f) {
  return !f.complex && (f.type == 1 || (f.type == 0 && f.abscissa.type == kTime));
}

bool IsResponse(const UniversalFunction& f) {
  return f.complex && (f.type == 4 || f.type == 5) &&
         (f.abscissa.type == kFrequency || f.abscissa.type <= 1);
}

bool IsCoherence(const UniversalFunction& f) {
  return !f.complex && f.type == 6 && (f.abscissa.type == kFrequency || f.abscissa.type <= 1);
}

/// "A.x", "5+X", "A.x:5+X/B:1-Z": the shortest way of naming that tells all functions apart.
std::vector<std::string> FunctionNames(const std::vector<const UniversalFunction*>& functions) {
  using Naming = std::function<std::string(const UniversalFunction&)>;
  const auto reference = [](const UniversalFunction& f, const std::string& text) {
    return f.type == 1 || f.type == 0 || text.empty() ? "" : "/" + text;
  };
  const Naming ways[] = {
      [&](const UniversalFunction& f) {
        return f.response.name.empty() ? "" : f.response.name + reference(f, f.reference.name);
      },
      [&](const UniversalFunction& f) {
        const std::string response = f.response.text();
        return response.empty() ? "" : response + reference(f, f.reference.text());
      },
      [](const UniversalFunction& f) { return f.id[0]; },
      [](const UniversalFunction& f) { return f.id[4]; },
      [](const UniversalFunction& f) { return f.ordinate.label; },
  };
  std::vector<std::string> names;
  for (const Naming& way : ways) {
    names.clear();
    for (const UniversalFunction* f : functions) names.push_back(way(*f));
    const std::set<std::string> apart(names.begin(), names.end());
    if (apart.size() == names.size() && !apart.contains("")) return names;
  }
  names.clear();
  for (std::size_t k = 1; k <= functions.size(); ++k)
    names.push_back("function " + std::to_string(k));
  return names;
}

TimedChannel TimeChannel(const UniversalFunction& f, const std::string& name,
                         const std::string& path) {
  TimedChannel c{{name, f.ordinate.unit, f.real}};
  if (f.even) {
    if (!(f.step > 0) || !std::isfinite(f.first))
      throw InputError(path + ": " + name + ": abscissa from " + std::to_string(f.first) +
                       " in steps of " + std::to_string(f.step) + " s, allowed: steps above 0");
    c.rate = RateOfPeriod(f.step, kAbscissaDigits);
    c.start = f.first;
  } else {
    const TimeBase base = UniformTimeBase(f.x, path + ": abscissa of " + name);
    c.rate = base.rate;
    c.start = base.start;
  }
  return c;
}

std::vector<double> FrequenciesOf(const UniversalFunction& f) {
  if (!f.even) return f.x;
  std::vector<double> out(f.real.size());
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = f.first + static_cast<double>(k) * f.step;
  return out;
}

std::string ResponseUnit(const UniversalFunction& f) {
  const bool whole = f.denominator.unit.empty() || f.ordinate.unit.find('/') != std::string::npos;
  return whole ? f.ordinate.unit : f.ordinate.unit + "/" + f.denominator.unit;
}

/// All frequencies of functions, each once.
std::vector<double> AllFrequencies(const std::vector<const UniversalFunction*>& functions,
                                   const std::string& path) {
  std::vector<double> all;
  for (const UniversalFunction* f : functions) {
    const std::vector<double> axis = FrequenciesOf(*f);
    CheckFrequencies(axis, path);
    all.insert(all.end(), axis.begin(), axis.end());
  }
  std::ranges::sort(all);
  const auto twice = std::ranges::unique(all);
  all.erase(twice.begin(), twice.end());
  return all;
}

/// Values of a function over its own frequencies, at those of `all`: no numbers between its own.
template <class T>
std::vector<T> OverAll(const UniversalFunction& f, const std::vector<T>& values,
                       const std::vector<double>& all) {
  std::vector<T> out(all.size(), T(std::numeric_limits<double>::quiet_NaN()));
  const std::vector<double> axis = FrequenciesOf(f);
  for (std::size_t n = 0; n < axis.size(); ++n) {
    const auto at = std::ranges::lower_bound(all, axis[n]);
    if (at != all.end() && *at == axis[n])
      out[static_cast<std::size_t>(at - all.begin())] = values[n];
  }
  return out;
}

/// Frequency responses, and coherences by the names that responses have, over the frequencies of
/// all responses: each function has its own.
FrequencyResponses Responses(const std::vector<const UniversalFunction*>& functions,
                             const std::vector<const UniversalFunction*>& coherence,
                             const std::string& path) {
  FrequencyResponses out;
  const std::vector<std::string> names = FunctionNames(functions);
  out.frequency = AllFrequencies(functions, path);
  for (std::size_t k = 0; k < functions.size(); ++k) {
    const UniversalFunction& f = *functions[k];
    std::vector<std::complex<double>> values;
    for (std::size_t n = 0; n < f.real.size(); ++n) values.emplace_back(f.real[n], f.imaginary[n]);
    out.responses.push_back({names[k], ResponseUnit(f), OverAll(f, values, out.frequency)});
  }
  const std::vector<std::string> coherent = FunctionNames(coherence);
  for (std::size_t k = 0; k < coherence.size(); ++k) {
    std::vector<double> values = OverAll(*coherence[k], coherence[k]->real, out.frequency);
    const auto known = [](double v) { return std::isfinite(v); };
    if (std::ranges::any_of(values, known))
      out.coherence.push_back({coherent[k], std::move(values)});
  }
  CheckResponses(out, path);
  return out;
}

Measurement ReadUniversalFile(const std::string& path) {
  const std::string bytes = ReadFile(path);
  const std::vector<UniversalFunction> functions = ReadFunctions(path, bytes);
  if (functions.empty()) throw InputError(path + ": no data set 58 (function) in the file");
  std::vector<const UniversalFunction*> over_time, responses, coherence;
  std::vector<std::string> notes;
  for (std::size_t k = 0; k < functions.size(); ++k) {
    const UniversalFunction& f = functions[k];
    if (OverTime(f))
      over_time.push_back(&f);
    else if (IsResponse(f))
      responses.push_back(&f);
    else if (IsCoherence(f))
      coherence.push_back(&f);
    else
      notes.push_back(path + ": function " + std::to_string(k + 1) + " is of type " +
                      std::to_string(f.type) + (f.complex ? ", complex" : ", real") + ", left out");
  }
  if (over_time.empty() && responses.empty())
    throw InputError(path + ": neither a real time response (type 1) nor a complex frequency " +
                     "response (type 4), the first function is of type " +
                     std::to_string(functions.front().type));
  Measurement out;
  std::vector<TimedChannel> channels;
  const std::vector<std::string> names = FunctionNames(over_time);
  for (std::size_t k = 0; k < over_time.size(); ++k)
    channels.push_back(TimeChannel(*over_time[k], names[k], path));
  out.record = OneTimeBase(std::move(channels), path);
  out.frequency = Responses(responses, coherence, path);
  out.record.notes.insert(out.record.notes.end(), notes.begin(), notes.end());
  if (!out.record.channels.empty()) FinishRecord(out.record, path);
  return out;
}

}  // namespace

RecordFormat UniversalFile() {
  return {"UFF 58", ".unv .uff .uf", IsUniversalFile, ReadUniversalFile};
}

}  // namespace ambrig
