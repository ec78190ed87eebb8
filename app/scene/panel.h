// The tables of a scene that run it more than once: [sweep], [[panel]] and [[chart]].
#pragma once

#include "app/scene/section.h"

namespace tumble {

/// Names of every [[body]] and [[array]] of a scene's tree.
std::vector<std::string> partNames(const Node& tree);

void readSweep(Section& root, std::optional<Sweep>& sweep);
/// @param parts  names that the key `bodies` may hold
void readPanels(Section& root, const std::vector<std::string>& parts, Scene& scene);
void readGraphs(Section& root, const std::vector<std::string>& parts, Scene& scene);
void readCharts(Section& root, const std::vector<std::string>& parts, Scene& scene);

/// Changes a scene's tree into that of the variant: settings, then bodies with the forces between
/// them; panels, charts and sweep are taken out. Complains about settings that lead nowhere.
void apply(const Variant& variant, Node& tree, Findings& findings);

}  // namespace tumble
