// The impact law by default: each island of contacts by the law that is for its size.
#include <algorithm>
#include <numeric>

#include "sim/contact/impact.h"
#include "sim/contact/impact_pass.h"

namespace tumble {
namespace {

/// The same impact at some of its contacts alone.
struct Part {
  std::vector<int> ids;
  std::vector<Contact> contacts;
  std::vector<double> restitution;
  std::vector<Vec3> impulse;

  void take(const Impact& whole, int i) {
    ids.push_back(i);
    contacts.push_back(whole.contacts[i]);
    restitution.push_back(whole.restitution[i]);
    impulse.push_back(whole.impulse[i]);
  }
};

/// Weight of contacts of which those of a pair stand together.
int weightOf(std::span<const Contact> contacts, std::span<const int> ids) {
  int weight = 0;
  for (std::size_t k = 0, end = 0; k < ids.size(); k = end) {
    const Contact& first = contacts[ids[k]];
    while (end < ids.size() && contacts[ids[end]].a == first.a && contacts[ids[end]].b == first.b)
      ++end;
    weight += weightOfContacts(static_cast<int>(end - k), first.friction);
  }
  return weight;
}

}  // namespace

ImpactReport impactAuto(const Impact& impact) {
  const std::vector<int> reached = reachOfImpact(impact);
  if (weightOf(impact.contacts, reached) <= kReflectionsReach) return impactReflections(impact);
  const std::vector<int> island = islandsOfContacts(impact, reached);
  std::vector<Part> parts(*std::max_element(island.begin(), island.end()) + 1);
  for (std::size_t k = 0; k < reached.size(); ++k) parts[island[k]].take(impact, reached[k]);
  ImpactReport report;
  for (Part& part : parts) {
    Impact one = impact;
    one.contacts = part.contacts;
    one.restitution = part.restitution;
    one.impulse = part.impulse;
    const bool few = weightOf(impact.contacts, part.ids) <= kReflectionsReach;
    add(few ? impactReflections(one) : impactCrowd(one), report);
    for (std::size_t k = 0; k < part.ids.size(); ++k) impact.impulse[part.ids[k]] = part.impulse[k];
  }
  return report;
}

}  // namespace tumble
