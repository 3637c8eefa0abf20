#include "services/lab/simulated/camera_file.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <variant>
#include <vector>

#include "services/base/number.h"
#include "services/base/text_file.h"
#include "services/program/toml.h"

namespace trailcast::agent {
namespace {

constexpr const char* kFileEnding = ".toml";

using Field = std::variant<int*, double*, std::string*>;

// Returns where each key's value goes. `model` is a word until it is parsed.
std::map<std::string, Field> Fields(sim::CameraModel& camera, std::string& model) {
  return {{"name", &camera.name},
          {"width", &camera.width},
          {"height", &camera.height},
          {"model", &model},
          {"hfov_deg", &camera.horizontal_fov_deg},
          {"distortion", &camera.distortion},
          {"height_m", &camera.height_m},
          {"yaw_deg", &camera.yaw_deg},
          {"pitch_deg", &camera.pitch_deg},
          {"roll_deg", &camera.roll_deg},
          {"ahead_m", &camera.ahead_m},
          {"centre_u", &camera.centre_u},
          {"centre_v", &camera.centre_v},
          {"knock_yaw_deg", &camera.knock_yaw_deg},
          {"knock_at_s", &camera.knock_at_s},
          {"exposure_swing", &camera.exposure_swing},
          {"exposure_period_s", &camera.exposure_period_s},
          {"readout_s", &camera.readout_s}};
}

bool Assign(const Field& field, const std::string& text) {
  if (auto* const* number = std::get_if<int*>(&field)) return ReadNumber(text, **number);
  if (auto* const* real = std::get_if<double*>(&field)) {
    return ReadNumber(text, **real) && std::isfinite(**real);
  }
  *std::get<std::string*>(field) = text;
  return true;
}

const char* Expected(const Field& field) {
  if (std::holds_alternative<int*>(field)) return "a whole number";
  return std::holds_alternative<double*>(field) ? "a number" : "a word";
}

Result<void> Set(const std::map<std::string, Field>& fields, const CLI::ConfigItem& item) {
  const auto field = fields.find(item.fullname());
  if (field == fields.end()) {
    std::string accepted;
    for (const auto& [key, unused] : fields) accepted += (accepted.empty() ? "" : ", ") + key;
    return Fail(ErrorCode::kInvalidArgument, "unknown key '{}'; accepted are {}", item.fullname(),
                accepted);
  }
  if (item.inputs.size() == 1 && Assign(field->second, item.inputs.front())) return {};
  return Fail(ErrorCode::kInvalidArgument, "'{}' is '{}'; expected {}", field->first,
              item.inputs.empty() ? "" : item.inputs.front(), Expected(field->second));
}

Result<std::vector<CLI::ConfigItem>> Items(std::istream& stream) {
  try {
    return program::Toml().from_config(stream);
  } catch (const CLI::Error& unreadable) {
    return Fail(ErrorCode::kInvalidArgument, "{}", unreadable.what());
  }
}

Result<sim::CameraModel> Parse(std::istream& stream, sim::CameraModel camera) {
  std::string model;
  const auto fields = Fields(camera, model);
  const auto items = Items(stream);
  if (!items) return tl::unexpected(items.error());
  for (const CLI::ConfigItem& item : *items) {
    if (item.name == "++" || item.name == "--") continue;  // a section's beginning or end
    if (auto set = Set(fields, item); !set) return tl::unexpected(set.error());
  }
  if (!model.empty()) {
    auto parsed = sim::ParseLensModel(model);
    if (!parsed) return tl::unexpected(parsed.error());
    camera.model = *parsed;
  }
  if (auto valid = sim::Validate(camera); !valid) return tl::unexpected(valid.error());
  return camera;
}

Result<sim::CameraModel> FindOrRead(const std::string& word) {
  if (std::filesystem::path(word).extension() == kFileEnding) return ReadCameraFile(word);
  auto camera = sim::FindCamera(word);
  if (camera) return camera;
  return Fail(camera.error().code, "{}, or a file ending in {}", camera.error().message,
              kFileEnding);
}

}  // namespace

Result<sim::CameraModel> ReadCameraFile(const std::filesystem::path& file) {
  const auto text = ReadTextFile(file);
  if (!text) return Wrap(text.error(), "camera file");
  std::istringstream stream(*text);
  sim::CameraModel camera;
  camera.name = file.stem().string();
  auto parsed = Parse(stream, std::move(camera));
  if (!parsed) return Wrap(parsed.error(), "camera file " + file.string());
  return parsed;
}

Result<sim::CameraModel> CameraFromWord(const std::string& word) {
  // A file's own name may have a plus.
  const std::size_t plus = word.find('+', word.rfind(kFileEnding) + 1);
  auto camera = FindOrRead(word.substr(0, plus));
  if (!camera || plus == std::string::npos) return camera;
  const std::string base_name = camera->name;
  std::string changes = word.substr(plus);
  std::replace(changes.begin(), changes.end(), '+', '\n');
  std::istringstream lines(changes);
  auto changed = Parse(lines, std::move(*camera));
  if (!changed) return Wrap(changed.error(), "camera " + word);
  if (changed->name == base_name) changed->name += word.substr(plus);
  return changed;
}

}  // namespace trailcast::agent
