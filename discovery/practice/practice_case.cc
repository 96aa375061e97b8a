#include "discovery/practice/practice_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/math/noise.h"
#include "core/record/channels.h"
#include "discovery/experiment/measured_case.h"
#include "discovery/model/coil_errors.h"
#include "discovery/model/floor.h"
#include "discovery/practice/drawn_truth.h"
#include "discovery/practice/laws/practice_law.h"
#include "discovery/practice/loop_margin.h"
#include "discovery/practice/mistake_draw.h"
#include "discovery/practice/practice_surroundings.h"
#include "effects/catalogue.h"
#include "rig/clearance.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_channels.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

constexpr int kAttempts = 12;
constexpr double kMostNoise = 4;  // that laws may make of the noise of a channel, times

/// Streams of random numbers of one case.
enum PracticeStream : std::uint32_t {
  kChoiceStream = 201,
  kLawStream = 210,
  kMistakeStream = 230,
  kMistakeSizeStream = 231
};

// 9 one, 2 two, 1 three, 2 unknown, 2 nothing, 4 data
const char* const kKinds[] = {"one", "two",   "data",    "one", "unknown", "one",     "nothing",
                              "one", "three", "data",    "one", "one",     "unknown", "one",
                              "two", "data",  "nothing", "one", "data",    "one"};
constexpr std::size_t kPeriod = std::size(kKinds);
/// How many cases of its kind stand before number `number`.
std::size_t Ordinal(std::size_t number) {
  std::size_t n = 0;
  for (std::size_t k = 0; k < number; ++k)
    n += KindOfPracticeCase(k) == KindOfPracticeCase(number) ? 1 : 0;
  return n;
}

/// Laws of a kind in an order that visits all of them before one comes again.
const PracticeLaw& LawNumber(std::size_t place, bool known) {
  std::vector<const PracticeLaw*> all;
  for (const PracticeLaw& l : PracticeLaws())
    if (l.effect.empty() != known) all.push_back(&l);
  std::size_t stride = 7;
  while (all.size() % stride == 0) stride += 2;
  return *all[place * stride % all.size()];
}

struct ChosenLaw {
  const PracticeLaw* law = nullptr;
  std::string target;
};

class PracticeMaker {
 public:
  PracticeMaker(const std::vector<PracticeRig>& rigs, std::uint64_t seed, std::size_t number,
                std::uint64_t attempt, const std::atomic<bool>* stop)
      : seed_(seed * 100003 + number * 31 + attempt * 7919),
        number_(number),
        attempt_(attempt),
        choice_(seed_, kChoiceStream),
        stop_(stop) {
    out_.name = NameOfPracticeCase(number);
    out_.kind = KindOfPracticeCase(number);
    const PracticeRig& rig = rigs[(number + number / rigs.size()) % rigs.size()];
    out_.rig = rig.name;
    out_.rig_text = rig.text;
    if (choice_.Of(2) == 1) {
      out_.rig_text = WithOtherSizes(rig.text, rig.file, seed_);
      out_.rig += ", other size";
    }
    believed_ = ReadRigText(out_.rig_text, rig.file);
  }

  PracticeCase Run() {
    ChooseLaws();
    ExaminationNeeds needs;
    for (const ChosenLaw& c : laws_) {
      if (c.law->effect.empty()) continue;
      const EffectNeeds& n = EffectNamed(c.law->effect).needs;
      needs.contact = needs.contact || n.contact;
      needs.free_speed = needs.free_speed || n.free_speed;
    }
    out_.records = Examination(believed_, seed_, needs);
    out_.data = EmptyCase(believed_, out_.records);
    const bool exact = out_.kind == "nothing" && Ordinal(number_) % 2 == 1;
    truth_.rig = exact ? believed_ : DrawRig(believed_, seed_);
    RequireLoopMargin(truth_.rig);
    surroundings_ = DrawSurroundings(believed_, seed_);
    out_.noise = surroundings_.noise_mode;
    out_.nuisances = surroundings_.nuisance_mode;
    SetTrueNoise(surroundings_, truth_.rig, out_.data);
    HideLaws();
    out_.truth = truth_.rig;
    FillRecords(surroundings_, truth_, seed_, stop_, out_.data);
    if (out_.kind == "data") Mistake();
    Answers(exact);
    return std::move(out_);
  }

 private:
  void ChooseLaws() {
    const std::size_t ordinal = Ordinal(number_) + 3 * attempt_;
    std::vector<const PracticeLaw*> wanted;
    if (out_.kind == "one") wanted = {&LawNumber(ordinal, true)};
    if (out_.kind == "two")
      wanted = {&LawNumber(2 * ordinal + 3, true), &LawNumber(3 * ordinal + 14, true)};
    if (out_.kind == "three")
      wanted = {&LawNumber(2 * ordinal + 5, true), &LawNumber(3 * ordinal + 9, true),
                &LawNumber(5 * ordinal + 17, true)};
    if (out_.kind == "unknown") wanted = {&LawNumber(ordinal, false)};
    // half of the wrong data come from rigs with an effect
    if (out_.kind == "data" && ordinal % 2 == 1) wanted = {&LawNumber(ordinal + 5, true)};
    for (const PracticeLaw* law : wanted) {
      if (std::any_of(laws_.begin(), laws_.end(),
                      [&](const ChosenLaw& other) { return other.law->effect == law->effect; }))
        continue;
      const std::vector<std::string> targets = TargetsOfLaw(*law, believed_);
      if (targets.empty()) throw InputError(law->id + ": this rig has no target for this law");
      laws_.push_back({law, targets[choice_.Of(targets.size())]});
    }
  }

  LawSetting Setting(const ChosenLaw& c, std::size_t slot, double size) const {
    double reach = 1;
    for (const BearingParameters& b : believed_.bearings)
      if (b.kind->two_axes && (reach == 1 || c.target.starts_with(b.name))) reach = ClearanceOf(b);
    return {believed_, c.target,
            size,      believed_.rotor.mass * 9.81,
            reach,     PracticeDraw(seed_, kLawStream + static_cast<std::uint32_t>(slot))};
  }

  void HideLaws() {
    CaseModel model(out_.data);
    model.stop = stop_;
    const NoiseFloor floor = FindFloor(model, truth_);
    std::vector<EffectInstance> all;
    for (std::size_t k = 0; k < laws_.size(); ++k) {
      const auto visible = VisibleEffects(model, truth_, floor.clean, [&](double size) {
        return laws_[k].law->make(Setting(laws_[k], k, size));
      });
      if (!visible) throw InputError(laws_[k].law->id + ": no size is visible with the rotor held");
      all.insert(all.end(), visible->effects.begin(), visible->effects.end());
      out_.worst_ratio = std::max(out_.worst_ratio, visible->change.ratio);
      out_.laws.push_back(laws_[k].law->id + "@" + laws_[k].target);
      out_.families.push_back(laws_[k].law->family);
    }
    truth_.rig.effects = all;
    if (laws_.size() > 1 && !model.Predict(truth_))
      throw InputError(out_.name + ": the laws together lose the rotor");
    for (const EffectInstance& e : all)
      if (IsWithinCoilErrors(e, believed_))
        throw InputError(out_.name + ": what is hidden is no more than the spread of the coils");
    if (!laws_.empty()) RequireCalm(model);
    if (out_.kind == "nothing") parameters_show_ = ParametersShow(model, floor.clean);
  }

  /// Whether what the unit's parameters change of the records is more than a part of the noise. All
  /// rows count, those that noise makes unpredictable too.
  bool ParametersShow(const CaseModel& model, const std::vector<double>& as_drawn) const {
    constexpr double kShows = 1.05;  // error over the noise of the rig file's model
    const auto as_filed = model.Predict(Hypothesis::Base(believed_));
    if (!as_filed) return true;
    double change = 0;
    for (const Target& t : model.targets())
      for (std::size_t k = t.first; k < t.first + t.count; ++k)
        change += std::pow((as_drawn[k] - (*as_filed)[k]) / t.floor, 2);
    return std::sqrt(1 + change / static_cast<double>(model.size())) > kShows;
  }

  /// A law that brings the loops to the edge of stability leaves records of noise and initial
  /// states.
  void RequireCalm(const CaseModel& quiet) const {
    CaseModel model(out_.data);
    model.stop = stop_;
    FindFloor(model, truth_);
    for (std::size_t t = 0; t < quiet.targets().size(); ++t)
      if (model.targets()[t].floor > kMostNoise * quiet.targets()[t].floor)
        throw InputError(out_.name + ": with its laws the loop passes too much noise");
  }

  void Mistake() {
    const Spoiling what = DrawMistake(Ordinal(number_), PracticeDraw(seed_, kMistakeSizeStream));
    const std::vector<CaseRecord> sound = out_.data.records;
    const std::size_t first = PracticeDraw(seed_, kMistakeStream).Of(sound.size());
    for (std::size_t k = 0; k < sound.size(); ++k) {
      const std::size_t record = (first + k) % sound.size();
      try {
        const std::string done = Spoil(out_.data, record, what, seed_);
        if (ShowsMistake(sound[record], out_.data.records[record])) {
          out_.mistake = fmt::format("{}: {}", what.fault, done);
          return;
        }
      } catch (const InputError&) {  // this record cannot have it: the next one
      }
      out_.data.records = sound;
    }
    throw InputError(fmt::format("{}: no record can show the mistake {}", out_.name, what.fault));
  }

  void Answers(bool exact) {
    Answer& a = out_.answer;
    if (out_.kind == "data") {
      a.verdicts = {"data"};
    } else if (out_.kind == "unknown") {
      a.verdicts = {"unknown"};
    } else if (out_.kind == "nothing") {
      a.verdicts = {exact ? "none" : "parameters"};
      if (out_.nuisances != "none" || (!exact && !parameters_show_))
        a.verdicts.push_back(exact ? "parameters" : "none");
    } else {
      a.verdicts = {"effect"};
      for (const ChosenLaw& c : laws_) a.slots.push_back(RightNames(c.law->effect, c.target));
    }
    out_.for_fit =
        out_.families.empty() ? Ordinal(number_) % 2 == 0 : FamilyIsForFit(out_.families[0]);
    out_.case_text = PracticeCaseText(surroundings_, out_.records);
    out_.answer_text = PracticeAnswerText(out_, seed_);
  }

  std::uint64_t seed_;
  std::size_t number_;
  std::uint64_t attempt_;
  PracticeDraw choice_;
  const std::atomic<bool>* stop_;
  RigParameters believed_;
  Hypothesis truth_;
  Surroundings surroundings_;
  std::vector<ChosenLaw> laws_;
  bool parameters_show_ = true;
  PracticeCase out_;
};

}  // namespace

std::string KindOfPracticeCase(std::size_t number) { return kKinds[number % kPeriod]; }

std::string NameOfPracticeCase(std::size_t number) {
  return fmt::format("case-{:04d}", number + 1);
}

bool FamilyIsForFit(const std::string& family) {
  std::vector<std::string> order;
  for (const PracticeLaw& l : PracticeLaws())
    if (std::find(order.begin(), order.end(), l.family) == order.end()) order.push_back(l.family);
  return (std::find(order.begin(), order.end(), family) - order.begin()) % 2 == 0;
}

PracticeCase MakePracticeCase(const std::vector<PracticeRig>& rigs, std::uint64_t seed,
                              std::size_t number, const std::atomic<bool>* stop) {
  std::string why;
  for (std::uint64_t attempt = 0; attempt < kAttempts; ++attempt) {
    if (stop && stop->load()) throw Interrupted();
    try {
      return PracticeMaker(rigs, seed, number, attempt, stop).Run();
    } catch (const InputError& e) {  // this draw does not work: another one
      why = e.what();
    }
  }
  throw InputError(fmt::format("{}: {} draws failed, the last one because {}",
                               NameOfPracticeCase(number), kAttempts, why));
}

}  // namespace ambrig
