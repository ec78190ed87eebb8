// The word that a typing slip was meant to be.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tumble {

/// Levenshtein distance: the fewest insertions, deletions and replacements between two words.
int editDistance(std::string_view a, std::string_view b);

/// ", did you mean 'X'?" for the nearest name at most a third of the word away, or "".
std::string didYouMean(std::string_view word, std::span<const std::string> names);

}  // namespace tumble
