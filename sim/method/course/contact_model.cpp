// The table of contact models.
#include "sim/method/course/contact_model.h"

namespace tumble {
namespace {

constexpr ContactModel kModels[] = {
    {"constraint", "impulses at collisions, then forces that hold n·p″ ≥ 0", true,
     makeConstraintForces},
    {"penalty", "a spring and a damper at every point that overlaps (slide SH10)", false,
     makePenaltyForces},
};

}  // namespace

std::span<const ContactModel> contactModels() {
  return kModels;
}

const ContactModel* findContactModel(std::string_view name) {
  for (const ContactModel& model : kModels)
    if (model.name == name) return &model;
  return nullptr;
}

}  // namespace tumble
