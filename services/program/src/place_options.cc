#include "services/program/place_options.h"

#include <fmt/format.h>

#include <array>
#include <charconv>

#include "services/route/bounds.h"

namespace trailcast::program {
namespace {

using route::Place;

// "48.2,11.5"
std::optional<std::array<double, 2>> ParsePair(const std::string& text) {
  const char* end = text.data() + text.size();
  std::array<double, 2> pair{};
  const auto [comma, first] = std::from_chars(text.data(), end, pair[0]);
  if (first != std::errc() || comma == end || *comma != ',') return std::nullopt;
  const auto [rest, second] = std::from_chars(comma + 1, end, pair[1]);
  if (second != std::errc() || rest != end) return std::nullopt;
  return pair;
}

// On the globe people say latitude first; x is east.
Place PlaceFrom(Place::Frame frame, const std::array<double, 2>& pair) {
  if (frame == Place::Frame::kWgs84) return {frame, pair[1], pair[0]};
  return {frame, pair[0], pair[1]};
}

std::string Wrong(Place::Frame frame, const std::string& text) {
  const auto pair = ParsePair(text);
  if (!pair) return fmt::format("'{}' is not two numbers with a comma between", text);
  const auto possible = route::CheckPlace(PlaceFrom(frame, *pair));
  return possible ? "" : possible.error().message;
}

CLI::Option* AddOne(CLI::App& app, const std::string& flag, const std::string& help,
                    const std::string& form, Place::Frame frame, std::optional<Place>& place) {
  return app
      .add_option_function<std::string>(
          flag,
          [frame, &place](const std::string& text) {
            if (const auto pair = ParsePair(text)) place = PlaceFrom(frame, *pair);
          },
          help)
      ->check(CLI::Validator([frame](const std::string& text) { return Wrong(frame, text); }, ""))
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
