#include "app/scene/vary.h"

namespace tumble {

namespace {

constexpr std::size_t kDeepest = 4;  // parts of a key of a body

// The numbers of [1, 2, 3] or of 1; nothing if it is something else.
std::optional<std::vector<double>> numbersOf(const Node& node) {
  std::vector<double> numbers(1);
  if (node.number(numbers[0])) return numbers;
  const Array* array = node.as<Array>();
  if (!array || array->empty()) return {};
  numbers.resize(array->size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!(*array)[i].number(numbers[i])) return {};
  return numbers;
}

// Appends one variation for each pair in the table and the tables in it.
void collect(const Table& table, const std::vector<std::string>& above, const std::string& path,
             Findings& findings, std::vector<Variation>& variations) {
  for (const Entry& entry : table.entries) {
    std::vector<std::string> key = above;
    for (std::string& part : partsOf(entry.key)) key.push_back(std::move(part));
    const std::string name = path + "." + plain(entry.key);
    if (key.size() > kDeepest) {
      findings.complain(entry.spot, name, "no key of a body has so many parts");
      continue;
    }
    if (const Table* inner = entry.node.as<Table>()) {
      collect(*inner, key, name, findings, variations);
      continue;
    }
    const Array* ends = entry.node.as<Array>();
    std::optional<std::vector<double>> first, last;
    if (ends && ends->size() == 2) {
      first = numbersOf((*ends)[0]);
      last = numbersOf((*ends)[1]);
    }
    const bool list = first && (*ends)[0].as<Array>();
    if (!first || !last || first->size() != last->size() || list != !!(*ends)[1].as<Array>())
      findings.complain(entry.node.spot, name,
                        "expected [first, last], two numbers or two lists of as many numbers");
    else
      variations.push_back({std::move(key), entry.node.spot, list, *first, *last});
  }
}

}  // namespace

void Variation::apply(Table& body, int i, int n) const {
  Array values;
  for (std::size_t k = 0; k < first.size(); ++k) {
    double x = first[k];
    if (i > 0) x = i == n - 1 ? last[k] : ((n - 1 - i) * first[k] + i * last[k]) / (n - 1);
    values.push_back({spot, x});
  }
  Table* table = &body;
  for (std::size_t k = 0; k + 1 < key.size(); ++k) {
    Node& node = table->at(key[k], spot).node;
    if (!node.as<Table>()) node = {spot, Table{}};
    table = node.as<Table>();
  }
  Node& target = table->at(key.back(), spot).node;
  target.spot = spot;
  if (list)
    target.value = std::move(values);
  else
    target.value = values[0].value;
}

std::vector<Variation> readVary(Section& array) {
  std::vector<Variation> variations;
  const Node* node = array.find("vary");
  if (!node) return variations;
  if (const Table* table = node->as<Table>())
    collect(*table, {}, array.path("vary"), array.findings(), variations);
  else
    array.complain("vary", "expected a table like { restitution = [0.0, 1.0] }");
  return variations;
}

}  // namespace tumble
