#include "app/scene/override.h"

#include <charconv>

#include "app/scene/toml.h"

namespace tumble {

namespace {

constexpr std::size_t kLongestKey = 500;  // letters; bounds the depth of what is made, too

// The end of each way to cut a head off the path at a dot, longest head first.
std::vector<std::size_t> headsOf(std::string_view path) {
  std::vector<std::size_t> ends{path.size()};
  for (std::size_t i = path.size(); i-- > 0;)
    if (path[i] == '.') ends.push_back(i);
  return ends;
}

std::string_view behind(std::string_view path, std::size_t head) {
  return head < path.size() ? path.substr(head + 1) : std::string_view();
}

std::string_view firstPart(std::string_view path) {
  return path.substr(0, path.find('.'));
}

const std::string* nameOf(const Node& node) {
  const Table* table = node.as<Table>();
  const Entry* name = table ? table->find("name") : nullptr;
  return name ? name->node.as<std::string>() : nullptr;
}

// The element by name or number; the path moves on behind it.
Node* findElement(Array& array, std::string_view& path) {
  for (const std::size_t head : headsOf(path)) {
    for (Node& node : array) {
      const std::string* name = nameOf(node);
      if (!name || *name != path.substr(0, head)) continue;
      path = behind(path, head);
      return &node;
    }
  }
  const std::string_view first = firstPart(path);
  const char* const last = first.data() + first.size();
  std::size_t index = array.size();
  const std::from_chars_result end = std::from_chars(first.data(), last, index);
  if (end.ec != std::errc() || end.ptr != last || index >= array.size()) return nullptr;
  path = behind(path, first.size());
  return &array[index];
}

// The entry of a key; the path moves on behind it.
Entry* findEntry(Table& table, std::string_view& path) {
  for (const std::size_t head : headsOf(path)) {
    Entry* entry = table.find(path.substr(0, head));
    if (!entry) continue;
    path = behind(path, head);
    return entry;
  }
  return nullptr;
}

std::vector<std::string> namesIn(const Array& array) {
  std::vector<std::string> names;
  for (const Node& node : array)
    if (const std::string* name = nameOf(node)) names.push_back(*name);
  return names;
}

std::vector<std::string> keysOf(const Table& table) {
  std::vector<std::string> keys;
  for (const Entry& entry : table.entries) keys.push_back(entry.key);
  return keys;
}

}  // namespace

bool isKeyPath(const std::string& text) {
  return !text.empty() && text.front() != '.' && text.back() != '.' &&
         text.find("..") == std::string::npos && text.find('=') == std::string::npos;
}

Override splitOverride(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string key = text.substr(0, equals);
  if (equals == std::string::npos || !isKeyPath(key))
    throw UsageError("--set " + text +
                     ": expected KEY=VALUE, for example world.gravity=[0,-1.62,0]");
  return {key, text.substr(equals + 1)};
}

void apply(const Override& override, Spot spot, Node& root, Findings& findings) {
  std::string_view path = override.key;
  const auto refuse = [&](const std::string& what) { findings.complain(spot, override.key, what); };

  if (path.size() > kLongestKey) return refuse("no key of a scene is so long");

  // Walk down as far as the tree goes, making tables for known keys that are not written yet.
  Node* node = &root;
  const Node* materials = nullptr;
  while (!path.empty()) {
    if (Array* array = node->as<Array>()) {
      const std::string_view first = firstPart(path);
      node = findElement(*array, path);
      if (!node) return refuse("there is no " + inQuotes(first) + hint(first, namesIn(*array)));
      continue;
    }
    if (node->as<Moment>()) node->value = Table{};
    Table* table = node->as<Table>();
    if (!table) return refuse("leads below " + describe(*node) + ", which has no keys");
    Entry* entry = findEntry(*table, path);
    const std::string_view first = firstPart(path);
    if (!entry && node == materials)
      return refuse("there is no material " + inQuotes(first) + hint(first, keysOf(*table)));
    if (!entry) {
      entry = &table->at(first, spot);
      path = behind(path, first.size());
    }
    if (node == &root && entry->key == "materials") materials = &entry->node;
    node = &entry->node;
  }

  // The value, as TOML or as it stands.
  std::optional<Node> value = parseTomlValue(override.value, spot);
  *node = value ? std::move(*value) : Node{spot, override.value};
}

}  // namespace tumble
