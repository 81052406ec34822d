// Words that people typed, and what they may have meant.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace floe {

// Levenshtein's distance: how many letters to insert, delete or replace.
std::size_t edit_distance(std::string_view a, std::string_view b);

// The candidate that differs least from `word` when it is near enough to be a typing mistake, else "".
std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates);

// The candidates, the most similar to `word` first; those equally similar in their order.
std::vector<std::string> by_likeness(std::string_view word, std::vector<std::string> candidates);

}  // namespace floe
