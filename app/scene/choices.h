// The words that a scene may choose from: the rows of the tables in sim.
#pragma once

#include <string>
#include <vector>

namespace tumble {

std::vector<std::string> methodChoices();
std::vector<std::string> impactChoices();
std::vector<std::string> integratorChoices();
std::vector<std::string> solverChoices();
std::vector<std::string> presetChoices();     ///< of stepping
std::vector<std::string> pointPlanChoices();  ///< of stepping
std::vector<std::string> inertiaChoices();
std::vector<std::string> attitudeChoices();  ///< of the course
std::vector<std::string> planChoices();      ///< of the course
std::vector<std::string> contactChoices();   ///< of the course

}  // namespace tumble
