"""Every mutant of a small program behind its switch must do what the same mutant does by itself."""
import os
import pathlib
import subprocess
import tempfile

from mutation import switches
from mutation.sites import Mutant, sites

PROGRAM = """// "a + b" in a comment is no place of a mutant
#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace {

constexpr double kHalf = 0.5, kUnused = kHalf;
constexpr int kSize = 3;

struct Pair {
  static constexpr double kScale = 4.0;
  double a = 1.5, b = 0;
  Pair operator+(const Pair& o) const { return {a + o.a, b - o.b}; }
};

template <class T>
T Twice(T x) {
  return x + x;
}

double Sum(const std::vector<double>& v, bool all) {
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < v.size(); ++k) {
    const auto keep = [&](double x) { return all || x > kHalf && x <= Pair::kScale; };
    if (!keep(v[k])) continue;
    sum += v[k] * 2.0 - 1.0;
    ++count;
  }
  return count > 0 ? sum / count : -1.0;
}

}  // namespace

int main() {
  std::array<double, kSize> values{};
  values[0] = 7;
  const Pair p = Pair{1, 2} + Pair{3, 4};
  const std::string text = std::string("a") + "b";
  std::printf("%g %g %g %g %s\\n", Sum({0.25, 1, 3, 5}, false), Sum({0.25, 0.5}, true), p.a * p.b, Twice(values[0]),
              text.c_str());
  std::printf("%d\\n", values[0] == 7 && text != "b");
}
"""


def output(program, mutant=0):
    environment = {**os.environ, "AMBRIG_MUTANT": str(mutant)}
    done = subprocess.run([str(program)], capture_output=True, text=True, env=environment, timeout=20)
    return done.returncode, done.stdout


def built(folder, name, text, *options):
    source = folder / f"{name}.cc"
    source.write_text(text)
    done = subprocess.run(["c++", "-std=c++20", "-w", *options, str(source), "-o", str(folder / name)], capture_output=True)
    return folder / name if done.returncode == 0 else None


def run():
    """Exit code: 0 when all mutants agree."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        file = folder / "program.cc"
        file.write_text(PROGRAM)
        (folder / "switches.h").write_text(switches.HEADER)
        mutants = [Mutant(folder, file, *s) for s in sites(PROGRAM)]
        for k, mutant in enumerate(mutants, 1):
            mutant.number = k
        trees = switches.Trees(["-std=c++20"])
        trees.read([file])
        wraps, declined = switches.switched(trees, file, mutants)
        sound = {}  # number -> program with this one mutant, written into the text
        for w in wraps:
            m = w.mutant
            sound[m.number] = built(folder, f"plain{m.number}", PROGRAM[:m.first] + m.new + PROGRAM[m.last:])
        wraps = [w for w in wraps if sound[w.mutant.number] and built(
            folder, "alone", switches.with_switches(PROGRAM, [w]), "-include", str(folder / "switches.h"), "-c")]
        text = switches.with_switches(PROGRAM, wraps) + switches.SOURCE
        whole = built(folder, "whole", text, "-include", str(folder / "switches.h"), f"-DAMBRIG_MUTANTS={len(mutants)}")
        if whole is None or output(whole) != output(built(folder, "healthy", PROGRAM)):
            print("the program with all switches is not the healthy one")
            return 1
        wrong = [w.mutant for w in wraps if output(whole, w.mutant.number) != output(sound[w.mutant.number])]
        for m in wrong:
            print(f"line {m.line}: {m.before.strip()} -> {m.after.strip()}: the switch gives {output(whole, m.number)}")
        print(f"{len(mutants)} places, {len(wraps)} behind switches, {len(wrong)} wrong; declined: "
              f"{sorted({why for _, why in declined})}")
        return 1 if wrong or len(wraps) < 40 else 0
