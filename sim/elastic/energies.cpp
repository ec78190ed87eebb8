// The table of energies. To add one: a struct in element.h, a file, and its row here.
#include <iterator>

#include "sim/elastic/element.h"

namespace tumble {
namespace {

constexpr EnergyKind kKinds[] = {
    {.name = "spring", .summary = "two points at a natural length"},
    {.name = "cloth stretch", .summary = "threads of cloth that get longer or shorter"},
    {.name = "cloth shear", .summary = "threads of cloth that lean against each other"},
    {.name = "cloth bend", .summary = "threads of cloth that bend or twist"},
    {.name = "strand bend", .summary = "a strand that turns from piece to piece"},
    {.name = "corotated", .summary = "a solid, linear in its stretches"},
    {.name = "neo-hookean", .summary = "a solid as of rubber"},
    {.name = "shape match", .summary = "a cell that is drawn to its shape at rest, turned along"},
    {.name = "cloth point", .summary = "a point of cloth pressed on a triangle of cloth"},
    {.name = "cloth edges", .summary = "edges of cloth pressed on each other"},
};
static_assert(std::size(kKinds) == std::variant_size_v<Energy>, "every energy has its row");

template <int Points>
ElementVector timesOf(const ElementMatrix& A, const ElementVector& v) {
  ElementVector out = ElementVector::Zero();
  out.head<3 * Points>() = A.topLeftCorner<3 * Points, 3 * Points>() * v.head<3 * Points>();
  return out;
}

}  // namespace

ElementVector elementTimes(const ElementMatrix& A, const ElementVector& v, int points) {
  return points <= kFewPoints ? timesOf<kFewPoints>(A, v) : timesOf<kElementPoints>(A, v);
}

std::span<const EnergyKind> energyKinds() {
  return kKinds;
}

void differentiate(const Energy& energy, const ElementPlaces& x, ElementAsk ask,
                   ElementTerms& terms) {
  std::visit([&](const auto& law) { differentiate(law, x, ask, terms); }, energy);
}

}  // namespace tumble
