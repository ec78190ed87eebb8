#include "sim/ode/system.h"

namespace tumble {

std::string_view missing(const Offers& offered, const Offers& needed) {
  if (needed.jet && !offered.jet) return "a Taylor jet";
  if (needed.lie && !offered.lie) return "an action of a Lie group";
  if (needed.split <= offered.split) return "";
  switch (needed.split) {
    case Split::None:
      return "";
    case Split::Rough:
      return "a kick and a drift";
    case Split::Symmetric:
      return "a kick and a drift that can be undone";
    case Split::Exact:
      return "a kick and a drift that are exact";
  }
  return "";
}

}  // namespace tumble
