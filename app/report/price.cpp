#include "app/report/price.h"

#include <fmt/format.h>

#include "app/file/html.h"
#include "app/record/output.h"
#include "app/record/recording.h"
#include "app/report/cost.h"

namespace tumble {

namespace {

// Whether the scene's method takes it and comes to its end.
bool runsThrough(const Scene& scene) {
  try {
    World world = makeWorld(scene);
    world.advance(scene.world.duration);
    return !world.report().stopped;
  } catch (const SceneError&) {
    return false;
  }
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

std::vector<Price> pricesOf(const std::vector<Scene>& scenes, double budget) {
  std::vector<Price> prices;
  for (const Scene& scene : scenes) {
    Price& price = prices.emplace_back(Price{scene.title, makeWorld(scene).features(), {}});
    for (const MethodName& method : methodNames()) {
      Scene asked = scene;
      asked.world.method = method.name;
      price.seconds.push_back(runsThrough(asked) ? std::optional(cpuShares({asked}, budget).front())
                                                 : std::nullopt);
    }
  }
  return prices;
}

std::string priceCsv(const std::vector<Price>& prices) {
  const std::vector<MethodName> methods = methodNames();
  std::string csv = "scene,method,cpu_seconds_per_second,uses\n";
  for (const Price& price : prices)
    for (std::size_t k = 0; k < methods.size(); ++k)
      if (price.seconds[k])
        csv += fmt::format("{},{},{:.4g},{}\n", csvQuoted(price.scene), methods[k].name,
                           *price.seconds[k], csvQuoted(joined(price.uses)));
  return csv;
}

std::string priceTable(const std::vector<Price>& prices) {
  std::string out = "<table><tr><th>scene</th><th>uses</th>";
  for (const MethodName& method : methodNames())
    out += fmt::format("<th>{}, µs per s</th>", method.name);
  out += "</tr>\n";
  for (const Price& price : prices) {
    out += fmt::format("<tr><td>{}</td><td>{}</td>", htmlText(price.scene),
                       htmlText(joined(price.uses)));
    for (const std::optional<double>& seconds : price.seconds)
      out += seconds ? fmt::format("<td>{:.3g}</td>", 1e6 * *seconds) : "<td>–</td>";
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

}  // namespace tumble
