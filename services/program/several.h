#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "services/base/result.h"
#include "services/program/parses_by.h"

namespace trailcast::program {

// Adds an option that may be given several times. `parse` reads each text, and `take` gets all of
// them.
template <typename Value>
CLI::Option* AddSeveral(CLI::App& app, const std::string& flag, const std::string& form,
                        Result<Value> (*parse)(const std::string&),
                        std::type_identity_t<std::function<void(std::vector<Value>)>> take,
                        const std::string& help) {
  return app
      .add_option_function<std::vector<std::string>>(
          flag,
          [parse, take = std::move(take)](const std::vector<std::string>& texts) {
            std::vector<Value> values;
            for (const std::string& text : texts) values.push_back(parse(text).value());
            take(std::move(values));
          },
          help + "; may be given several times")
      ->check(ParsesBy(parse, form))
      ->expected(1, 20)
      ->take_all()
      ->allow_extra_args(false);
}

}  // namespace trailcast::program
