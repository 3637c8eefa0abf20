#include "services/program/place_options.h"

#include <fmt/format.h>

#include "services/program/parses_by.h"
#include "services/route/query_words.h"

namespace trailcast::program {
namespace {

using route::Place;

CLI::Option* AddOne(CLI::App& app, const std::string& flag, const std::string& help,
                    const std::string& form, Place::Frame frame, std::optional<Place>& place) {
  return app
      .add_option_function<std::string>(
          flag,
          [frame, &place](const std::string& text) {
            if (const auto read = route::ReadPlace(frame, text)) place = *read;
          },
          help)
      ->check(
          ParsesBy([frame](const std::string& text) { return route::ReadPlace(frame, text); }, ""))
      ->type_name(form);
}

}  // namespace

void AddPlaceOptions(CLI::App& app, const std::string& stem, const std::string& what,
                     std::optional<Place>& place) {
  CLI::Option* site =
      AddOne(app, fmt::format("--{}-site", stem), what + ": metres in the site's own frame", "X,Y",
             Place::Frame::kSite, place);
  AddOne(app, fmt::format("--{}-gps", stem), what + ": degrees north and east", "LAT,LON",
         Place::Frame::kWgs84, place)
      ->excludes(site);
}

}  // namespace trailcast::program
