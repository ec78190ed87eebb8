#include "app/scene/numbers.h"

#include <algorithm>

namespace tumble {
namespace {

// In a formula '-' subtracts.
std::string asName(std::string key) {
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

void gather(const std::string& path, const Node& node, std::map<std::string, double>& numbers) {
  if (double number; node.number(number)) numbers[asName(path)] = number;
  const std::string start = path.empty() ? "" : path + ".";
  if (const Table* table = node.as<Table>())
    for (const Entry& entry : table->entries) gather(start + entry.key, entry.node, numbers);
  if (const Array* array = node.as<Array>())
    for (std::size_t k = 0; k < array->size(); ++k) {
      const Node& one = (*array)[k];
      gather(one.as<Table>() ? pathOf(path, one, k) : start + std::to_string(k), one, numbers);
    }
}

}  // namespace

std::map<std::string, double> numbersOf(const Node& tree) {
  std::map<std::string, double> numbers;
  gather("", tree, numbers);
  return numbers;
}

}  // namespace tumble
