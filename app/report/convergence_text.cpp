// A convergence as tables of text and as CSV.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/file/html.h"
#include "app/record/output.h"
#include "app/report/convergence.h"

namespace tumble {

namespace {

// A number in a column of so many places, or a dash where there is none.
std::string cell(double value, int width) {
  return std::isfinite(value) ? fmt::format("{:>{}.3g}", value, width)
                              : fmt::format("{:>{}}", "-", width);
}

double at(const std::vector<double>& values, std::size_t k) {
  return k < values.size() ? values[k] : MethodAt::kNone;
}

void addRows(const std::string& name, const MethodAt& method, std::string& out) {
  for (std::size_t k = 0; k < method.steps.size(); ++k)
    out += fmt::format("  {:<10}{}{}{}{}{}\n", k == 0 ? name : "",
                       cell(method.steps[k] > 0.0 ? method.steps[k] : MethodAt::kNone, 12),
                       cell(at(method.differences, k), 14), cell(method.richardson.errors[k], 14),
                       cell(at(method.offReference, k), 14), cell(method.seconds[k], 12));
}

// What the rows of a method come to, in a line.
void addVerdict(const Convergence& convergence, const ConvergenceAt& instant, std::size_t i,
                std::string& out) {
  const MethodAt& method = instant.methods[i];
  out += fmt::format("  {}: {}", convergence.methods[i], wordFor(method));
  if (!method.steps.empty()) out += fmt::format("; rounding makes {:.2g} m", method.noise);
  if (method.elsewhere)
    out +=
        fmt::format("; {:.2g} m from {}, far beyond the errors of both", method.offReference.back(),
                    convergence.methods[static_cast<std::size_t>(instant.reference)]);
  if (!method.missing.empty()) out += "; " + method.missing;
  out += "\n";
}

}  // namespace

std::string convergenceText(const Convergence& convergence) {
  std::string out = fmt::format(
      "{}\nLengths in m: how far the farthest point of a body is from where it is in the other "
      "run.\n",
      convergence.scene);
  for (const ConvergenceAt& instant : convergence.instants) {
    const std::string reference =
        instant.reference < 0
            ? "no reference"
            : "off " + convergence.methods[static_cast<std::size_t>(instant.reference)];
    out += fmt::format("\nt = {:.6g} s\n  {:<10}{:>12}{:>14}{:>14}{:>14}{:>12}\n", instant.t,
                       "method", "step / s", "to its half", "error", reference, "CPU / s");
    for (std::size_t i = 0; i < instant.methods.size(); ++i)
      addRows(convergence.methods[i], instant.methods[i], out);
    for (std::size_t i = 0; i < instant.methods.size(); ++i)
      addVerdict(convergence, instant, i, out);
  }
  return out;
}

std::string convergenceTable(std::span<const Convergence> scenes) {
  std::string out =
      "<table><tr><th>scene</th><th>method</th><th>t / s</th><th>says</th><th>error, first run</th>"
      "<th>last run</th><th>off the reference</th><th>CPU s per s, first run</th></tr>\n";
  for (const Convergence& scene : scenes)
    for (std::size_t i = 0; i < scene.methods.size(); ++i) {
      const auto& all = scene.instants;
      const auto found = std::find_if(all.rbegin(), all.rend(), [&](const ConvergenceAt& instant) {
        return !instant.methods[i].steps.empty();
      });
      const ConvergenceAt& instant = found == all.rend() ? all.front() : *found;
      const MethodAt& method = instant.methods[i];
      out += fmt::format("<tr><td>{}</td><td>{}</td>", htmlText(scene.scene),
                         htmlText(scene.methods[i]));
      if (method.steps.empty()) {
        out += fmt::format("<td>–</td><td colspan=\"5\">{}</td></tr>\n", htmlText(method.missing));
        continue;
      }
      out += fmt::format("<td>{:.3g}</td><td>{}</td>", instant.t, htmlText(wordFor(method)));
      for (const double value :
           {method.richardson.errors.front(), method.richardson.errors.back(),
            at(method.offReference, method.steps.size() - 1), method.seconds.front() / instant.t})
        out +=
            fmt::format("<td>{}</td>", std::isfinite(value) ? fmt::format("{:.1e}", value) : "–");
      out += "</tr>\n";
    }
  return out + "</table>\n";
}

std::string convergenceCsv(const Convergence& convergence) {
  const auto number = [](double value) {
    return std::isfinite(value) ? fmt::format("{:.17g}", value) : std::string();
  };
  std::string csv = "t,method,step,difference,order,error,off_reference,noise,cpu_seconds,says\n";
  for (const ConvergenceAt& instant : convergence.instants)
    for (std::size_t i = 0; i < instant.methods.size(); ++i) {
      const MethodAt& method = instant.methods[i];
      const bool converges = method.richardson.halving == Halving::Converges;
      std::string says = wordFor(method);
      if (!method.missing.empty()) says += "; " + method.missing;
      // A method without a run here has a row with its reason.
      for (std::size_t k = 0; k < std::max<std::size_t>(method.steps.size(), 1); ++k)
        csv +=
            fmt::format("{:.17g},{},{},{},{},{},{},{},{},{}\n", instant.t, convergence.methods[i],
                        number(at(method.steps, k)), number(at(method.differences, k)),
                        number(converges ? method.richardson.order : MethodAt::kNone),
                        number(at(method.richardson.errors, k)), number(at(method.offReference, k)),
                        number(method.noise), number(at(method.seconds, k)), csvQuoted(says));
    }
  return csv;
}

}  // namespace tumble
