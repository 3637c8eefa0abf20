#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>

namespace trailcast::program {

// Refuses a flag's text that `parse` refuses, in its words. `parse` takes a string and returns a
// Result; `form` stands in the help, as "X,Y".
template <typename Parse>
[[nodiscard]] CLI::Validator ParsesBy(Parse parse, std::string form) {
  const auto wrong = [parse = std::move(parse)](const std::string& text) {
    const auto read = parse(text);
    return read ? std::string() : read.error().message;
  };
  return {wrong, std::move(form)};
}

}  // namespace trailcast::program
