// An ice-model directory made from the built-in ice, detector and acceptance, with every file that
// floe reads, for tests to use and to spoil.
#pragma once

#include <filesystem>
#include <string>

namespace floe::test {

// `directory` is made. Layers of 10 m, 1D tilt, efficiencies, high-QE types, voltages, cables, DOM axes.
void write_model_directory(const std::filesystem::path& directory);

// Makes line `number` (from 1) of a text file read `text`, e.g. to spoil it.
void replace_line(const std::filesystem::path& file, std::size_t number, const std::string& text);
void append_line(const std::filesystem::path& file, const std::string& text);
void swap_lines(const std::filesystem::path& file, std::size_t first, std::size_t second);
// Keeps the first `count` lines.
void keep_lines(const std::filesystem::path& file, std::size_t count);

}  // namespace floe::test
