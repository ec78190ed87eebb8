#include "app/scene/panel.h"

#include <algorithm>

#include "app/scene/override.h"

namespace tumble {

namespace {

constexpr std::size_t kMostValues = 10'000;  // of a sweep
constexpr std::size_t kMostPanels = 100;     // of a page, and curves of a chart

// The texts of a list of values.
std::vector<std::string> readValues(Section& section) {
  std::vector<std::string> texts;
  const Node* values = section.find("values");
  const Array* list = values ? values->as<Array>() : nullptr;
  if (!list || list->empty() || list->size() > kMostValues) {
    section.complain("values", "expected a list of 1 to 10000 values" +
                                   (values ? ", found " + describe(*values) : ""));
    return texts;
  }
  for (const Node& value : *list) texts.push_back(toToml(value));
  return texts;
}

// The key path that the values of a sweep or chart are put at.
void readParameter(Section& section, std::string_view key, const char* example, Sweep& sweep) {
  section.read(key, sweep.parameter);
  const Node* node = section.find(key);
  sweep.spot = node ? node->spot : section.spot();
  if (!isKeyPath(sweep.parameter))
    section.complain(key, std::string("expected a key, for example \"") + example + "\"");
  sweep.values = readValues(section);
}

// set = { "key.path" = value, … }
void readSettings(Section& section, Variant& variant) {
  const Node* node = section.find("set");
  if (!node) return;
  const Table* table = node->as<Table>();
  if (!table)
    return section.complain("set", "expected a table like { \"course.integrator\" = \"euler\" }");
  for (const Entry& entry : table->entries) {
    const std::string path = section.path("set");
    if (!isKeyPath(entry.key))
      section.findings().complain(entry.spot, path, plain(entry.key) + " is no key of a scene");
    else if (entry.node.as<Table>() && entry.key.find('.') == std::string::npos)
      section.findings().complain(entry.spot, path,
                                  "replaces all of " + entry.key + "; write the whole key in " +
                                      "quotes, for example \"course.integrator\" = \"euler\"");
    else
      variant.set.push_back({entry.key + "=" + toToml(entry.node), entry.node.spot});
  }
}

// A line of a page, a legend and a table.
void readLine(Section& section, std::string_view key, std::string& line) {
  section.read(key, line);
  const auto control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  if (std::any_of(line.begin(), line.end(), control))
    section.complain(key, "expected one line without control characters, found " + inQuotes(line));
}

void readVariant(Section& section, std::string_view title, const std::vector<std::string>& parts,
                 Variant& variant) {
  readLine(section, title, variant.title);
  section.read("bodies", variant.bodies);
  const Node* bodies = section.find("bodies");
  if (const Array* list = bodies ? bodies->as<Array>() : nullptr; list && list->empty())
    section.complain("bodies", "expected at least one name; without this key all bodies live");
  for (const std::string& name : variant.bodies)
    if (std::find(parts.begin(), parts.end(), name) == parts.end())
      section.complain("bodies",
                       "there is no [[body]] or [[array]] " + inQuotes(name) + hint(name, parts));
  readSettings(section, variant);
}

void readCurves(Section& chart, const std::vector<std::string>& parts, ChartDef& def) {
  const Array& curves = chart.tables("curves");
  if (curves.empty() || curves.size() > kMostPanels)
    chart.complain("curves", "expected 1 to 100 tables like { label = \"Euler\", set = {…} }");
  for (const Node& node : curves) {
    CurveDef& curve = def.curves.emplace_back();
    Section section(node, chart.path("curves." + std::to_string(def.curves.size() - 1)),
                    chart.findings());
    readVariant(section, "label", parts, curve.variant);
    curve.along = def.along;
    if (section.find("along"))
      readParameter(section, "along", "course.step", curve.along);
    else if (section.find("values"))
      curve.along.values = readValues(section);
    section.finish();
    if (section.good() && curve.variant.title.empty())
      section.complain("label", "expected the curve's name, for example \"Euler\"");
  }
}

void readGraphCurves(Section& section, const std::string& where,
                     const std::vector<std::string>& parts, GraphDef& graph) {
  const Array& curves = section.tables("curves");
  if (curves.empty() || curves.size() > kMostPanels)
    section.complain("curves", "expected 1 to 100 tables like { label = \"k = 100\", set = {…} }");
  for (const Node& node : curves) {
    const std::string index = std::to_string(graph.curves.size());
    GraphCurve& curve = graph.curves.emplace_back();
    Section one(node, section.path("curves." + index), section.findings(),
                where + ".curves[" + index + "]");
    readVariant(one, "label", parts, curve.variant);
    one.read("value", curve.value);
    if (curve.value.empty() == (graph.shows == "values"))
      one.complain("value", graph.shows == "values"
                                ? "expected a formula, for example \"ball.py\" or \"energy\""
                                : "formulas are drawn by shows = \"values\"");
    one.finish();
  }
}

// A force belongs to the bodies that it names; one of an array counts for its array.
bool namesOneOf(const Node& force, const std::vector<std::string>& gone) {
  const Table* table = force.as<Table>();
  if (!table) return false;
  for (const char* key : {"body", "a", "b"}) {
    const Entry* entry = table->find(key);
    const std::string* name = entry ? entry->node.as<std::string>() : nullptr;
    if (!name) continue;
    for (const std::string& part : gone)
      if (*name == part || name->starts_with(part + ".")) return true;
  }
  return false;
}

// A claim about a body goes with it.
bool asksForOneOf(const Node& expect, const std::vector<std::string>& gone) {
  const Table* table = expect.as<Table>();
  if (!table) return false;
  return std::any_of(table->entries.begin(), table->entries.end(), [&](const Entry& entry) {
    const std::string* formula = entry.key == "label" ? nullptr : entry.node.as<std::string>();
    return formula && std::any_of(gone.begin(), gone.end(), [&](const std::string& part) {
             return formula->find(part + ".") != std::string::npos;
           });
  });
}

const std::string* nameOf(const Node& node) {
  const Table* table = node.as<Table>();
  const Entry* name = table ? table->find("name") : nullptr;
  return name ? name->node.as<std::string>() : nullptr;
}

// The elements of an array of tables at a key of the root, or null.
Array* elements(Node& tree, std::string_view key) {
  Table* root = tree.as<Table>();
  Entry* entry = root ? root->find(key) : nullptr;
  return entry ? entry->node.as<Array>() : nullptr;
}

// The tables of what a panel may name.
constexpr const char* kParts[] = {"body", "array", "cloth", "fur", "soft"};

void keepBodies(const std::vector<std::string>& kept, Node& tree) {
  std::vector<std::string> gone;
  for (const char* kind : kParts)
    if (Array* parts = elements(tree, kind))
      std::erase_if(*parts, [&](const Node& part) {
        const std::string* name = nameOf(part);
        if (!name || std::find(kept.begin(), kept.end(), *name) != kept.end()) return false;
        gone.push_back(*name);
        return true;
      });
  for (const char* kind : {"force", "joint", "text"})
    if (Array* forces = elements(tree, kind))
      std::erase_if(*forces, [&](const Node& force) { return namesOneOf(force, gone); });
  if (Array* expects = elements(tree, "expect"))
    std::erase_if(*expects, [&](const Node& expect) { return asksForOneOf(expect, gone); });
}

}  // namespace

Variant joined(const Variant& outer, const Variant& inner) {
  Variant both = inner;
  both.set.insert(both.set.begin(), outer.set.begin(), outer.set.end());
  if (both.bodies.empty()) both.bodies = outer.bodies;
  return both;
}

std::vector<std::string> partNames(const Node& tree) {
  std::vector<std::string> names;
  const Table* root = tree.as<Table>();
  for (const char* kind : kParts) {
    const Entry* entry = root ? root->find(kind) : nullptr;
    const Array* parts = entry ? entry->node.as<Array>() : nullptr;
    if (!parts) continue;
    for (const Node& part : *parts)
      if (const std::string* name = nameOf(part)) names.push_back(*name);
  }
  return names;
}

void readSweep(Section& root, std::optional<Sweep>& sweep) {
  const Node* node = root.find("sweep");
  if (!node) return;
  Section section(*node, "sweep", root.findings());
  Sweep read;
  readParameter(section, "parameter", "materials.rubber.restitution", read);
  section.finish();
  if (section.good()) sweep = read;
}

void readPanels(Section& root, const std::vector<std::string>& parts, Scene& scene) {
  const Array& panels = root.tables("panel");
  if (panels.size() > kMostPanels) return root.complain("panel", "a page takes up to 100 panels");
  for (const Node& node : panels) {
    PanelDef& panel = scene.panels.emplace_back();
    panel.spot = node.spot;
    Section section(node, "panel." + std::to_string(scene.panels.size() - 1), root.findings());
    readVariant(section, "title", parts, panel.variant);
    readLine(section, "subtitle", panel.subtitle);
    section.read("picture", panel.picture, {"strobe", "still", "state"});
    section.read("at", panel.at, notNegative("s"));
    section.read("slides", panel.slides);
    if (section.find("at") && panel.picture != "still")
      section.complain("at", "only a still is taken at an instant; add picture = \"still\"");
    section.finish();
  }
}

void readGraphs(Section& root, const std::vector<std::string>& parts, Scene& scene) {
  for (const Node& node : root.tables("graph")) {
    if (scene.graphs.size() == kMostPanels) return root.complain("graph", "at most 100 graphs");
    const std::string index = std::to_string(scene.graphs.size());
    GraphDef& graph = scene.graphs.emplace_back();
    Section section(node, "graph." + index, root.findings(), "graph[" + index + "]");
    readVariant(section, "title", parts, graph.variant);
    readLine(section, "subtitle", graph.subtitle);
    section.read("body", graph.body);
    section.read(
        "shows", graph.shows,
        {"height", "velocity", "force", "joint", "energy", "planes", "pairs", "holds", "values"});
    readLine(section, "axis", graph.axis);
    readLine(section, "against", graph.against);
    readLine(section, "across", graph.across);
    section.read("slides", graph.slides);
    const auto named = [&](const BodyDef& body) { return body.name == graph.body; };
    const bool ofAll = graph.shows == "planes" || graph.shows == "pairs" ||
                       graph.shows == "holds" || graph.shows == "values" ||
                       (graph.shows == "energy" && graph.body.empty());
    if (!ofAll && graph.body.empty())
      section.complain("body", "missing; expected the name of the body that it is of");
    else if (!ofAll && std::none_of(scene.world.bodies.begin(), scene.world.bodies.end(), named))
      section.complain("body", "expected the name of a body, found " + inQuotes(graph.body));
    readGraphCurves(section, "graph[" + index + "]", parts, graph);
    section.finish();
  }
}

void readCharts(Section& root, const std::vector<std::string>& parts, Scene& scene) {
  for (const Node& node : root.tables("chart")) {
    if (scene.charts.size() == kMostPanels) return root.complain("chart", "at most 100 charts");
    const std::string index = std::to_string(scene.charts.size());
    ChartDef& chart = scene.charts.emplace_back();
    Section section(node, "chart." + index, root.findings(), "chart[" + index + "]");
    readVariant(section, "title", parts, chart.variant);
    readLine(section, "subtitle", chart.subtitle);
    section.read("error", chart.error);
    if (chart.error.empty())
      section.complain("error", "expected the name of a check, whose largest error is drawn");
    readLine(section, "row", chart.row);
    readParameter(section, "along", "course.step", chart.along);
    section.read("cost", chart.cost, {"evaluations", "cpu", "value"});
    section.read("floor", chart.floor, positive({}));
    section.read("slides", chart.slides);
    readCurves(section, parts, chart);
    section.finish();
  }
}

void apply(const Variant& variant, Node& tree, Findings& findings) {
  for (const Setting& setting : variant.set)
    apply(splitOverride(setting.text), setting.spot, tree, findings);
  if (!variant.bodies.empty()) keepBodies(variant.bodies, tree);
  if (Table* root = tree.as<Table>())
    std::erase_if(root->entries, [](const Entry& entry) {
      return entry.key == "panel" || entry.key == "graph" || entry.key == "chart" ||
             entry.key == "sweep";
    });
}

}  // namespace tumble
