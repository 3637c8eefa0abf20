#include "services/lab/sim/core/load_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "services/image/files.h"
#include "services/lab/sim/core/path.h"
#include "services/lab/sim/core/simulated_robot.h"
#include "tests/support/places.h"
#include "tests/support/temp_dir.h"

namespace trailcast::sim {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;
using trailcast::test::TempDir;

// A wall across x = 2 and a floor, z up, with one material that may name a texture.
void WriteObj(const TempDir& folder, const std::string& texture_line) {
  std::ofstream(folder / "room.mtl") << "newmtl wall\nKd 0.8 0.4 0.2\n" << texture_line << "\n";
  std::ofstream(folder / "room.obj") << "mtllib room.mtl\nusemtl wall\n"
                                        "v -5 -5 0\nv 5 -5 0\nv 5 5 0\nv -5 5 0\n"
                                        "v 2 -1 0\nv 2 1 0\nv 2 1 2\nv 2 -1 2\n"
                                        "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                                        "f 1/1 2/2 3/3 4/4\nf 5/1 6/2 7/3 8/4\n";
}

std::string Base64(const std::string& bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      group = group << 8U | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0U);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      const bool padding = i + j > bytes.size();
      text += padding ? '=' : kDigits[group >> (18U - 6U * j) & 63U];
    }
  }
  return text;
}

// A triangle of 2 m x 2 m standing in glTF's y-up space, with its PNG texture inside the file.
void WriteGltf(const std::filesystem::path& file, const std::string& png) {
  const std::array<float, 15> numbers = {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 1, 1, 1, 0, 0};
  const std::string buffer(reinterpret_cast<const char*>(numbers.data()), sizeof(numbers));
  std::ofstream(file)
      << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
      << R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],)"
      << R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
      << R"("textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,)" << Base64(png)
      << R"("}],"buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,)"
      << Base64(buffer) << R"("}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},)"
      << R"({"buffer":0,"byteOffset":36,"byteLength":24}],"accessors":[{"bufferView":0,)"
      << R"("componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[2,2,0]},)"
      << R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}]})";
}

TEST(LoadWorld, MissingFileIsNotFoundAndNamed) {
  const auto world = LoadWorld({"/nowhere/place.glb"});
  ASSERT_FALSE(world);
  EXPECT_EQ(world.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(world.error().message, HasSubstr("/nowhere/place.glb"));
}

TEST(LoadWorld, FileThatIsNoWorldIsCorruptAndNamed) {
  const TempDir folder;
  std::ofstream(folder / "place.glb") << "no scene at all";
  const auto world = LoadWorld({folder / "place.glb"});
  ASSERT_FALSE(world);
  EXPECT_EQ(world.error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(world.error().message, HasSubstr("place.glb"));
}

TEST(LoadWorld, FileWithoutTrianglesIsRefused) {
  const TempDir folder;
  std::ofstream(folder / "points.obj") << "v 0 0 0\nv 1 0 0\nl 1 2\n";
  const auto world = LoadWorld({folder / "points.obj"});
  ASSERT_FALSE(world);
  EXPECT_THAT(world.error().message, HasSubstr("points.obj"));
}

TEST(LoadWorld, ScaleThatIsNoneIsRefused) {
  const TempDir folder;
  WriteObj(folder, "");
  const auto world = LoadWorld({folder / "room.obj", UpAxis::kZ, 0.0, GroundMode::kMesh});
  ASSERT_FALSE(world);
  EXPECT_EQ(world.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(world.error().message, HasSubstr("scale"));
}

TEST(LoadWorld, MissingTextureIsAWarningAndDrawnInPlainColour) {
  const TempDir folder;
  WriteObj(folder, "map_Kd lost.png");
  const auto world = LoadWorld({folder / "room.obj"});
  ASSERT_TRUE(world) << world.error().message;
  ASSERT_THAT((*world)->warnings(), SizeIs(1));
  EXPECT_THAT((*world)->warnings()[0], HasSubstr("lost.png"));
  const Material& wall = (*world)->material((*world)->surfaces()[0].material);
  EXPECT_EQ(wall.texture, nullptr);
  EXPECT_NEAR(wall.color.x(), 204.0F, 1.0F);
}

TEST(LoadWorld, TextureNamedWithBackslashesIsFound) {
  const TempDir folder;
  std::filesystem::create_directory(folder / "pictures");
  ASSERT_TRUE(image::WritePng(image::RgbImage{1, 1, {9, 8, 7}}, folder / "pictures" / "a.png"));
  WriteObj(folder, "map_Kd pictures\\a.png");
  const auto world = LoadWorld({folder / "room.obj"});
  ASSERT_TRUE(world) << world.error().message;
  EXPECT_THAT((*world)->warnings(), SizeIs(0));
}

TEST(LoadWorld, ScaleAndUpAxisPlaceTheWall) {
  const TempDir folder;
  WriteObj(folder, "");
  const auto world = LoadWorld({folder / "room.obj", UpAxis::kZ, 0.5, GroundMode::kMesh});
  ASSERT_TRUE(world) << world.error().message;
  const auto hit = (*world)->CastRay({0, 0, 0.5F}, Eigen::Vector3f::UnitX(), 10.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance_m, 1.0, 1e-4);
  // With y up, what was the wall's height (z) lies along -y.
  const auto turned = LoadWorld({folder / "room.obj", UpAxis::kY, 1.0, GroundMode::kMesh});
  ASSERT_TRUE(turned);
  EXPECT_TRUE((*turned)->CastRay({0, -1, 0}, Eigen::Vector3f::UnitX(), 10.0));
  EXPECT_FALSE((*turned)->CastRay({0, 1, 0.1F}, Eigen::Vector3f::UnitX(), 10.0));
}

TEST(LoadWorld, TextureInsideAGltfFileIsRead) {
  const TempDir folder;
  // Upper left red, upper right green, lower left blue, lower right white.
  const image::RgbImage picture{2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}};
  ASSERT_TRUE(image::WritePng(picture, folder / "t.png"));
  std::stringstream png;
  png << std::ifstream(folder / "t.png", std::ios::binary).rdbuf();
  WriteGltf(folder / "place.gltf", png.str());
  const auto world = LoadWorld({folder / "place.gltf", UpAxis::kY, 1.0, GroundMode::kMesh});
  ASSERT_TRUE(world) << world.error().message;
  EXPECT_THAT((*world)->warnings(), SizeIs(0));
  const auto hit = (*world)->CastRay({0.02F, -3.0F, 1.98F}, Eigen::Vector3f::UnitY(), 10.0);
  ASSERT_TRUE(hit);
  // The triangle's top has texture coordinates (0, 0): in glTF the picture's upper left, red.
  const Eigen::Vector2f uv = (*world)->TextureAt(hit->surface, {0.02F, 0.0F, 1.98F});
  const auto& texture = (*world)->material((*world)->surfaces()[hit->surface].material).texture;
  ASSERT_NE(texture, nullptr);
  const Eigen::Vector3f color = texture->Rgb(uv.x() + 0.25F, uv.y() + 0.25F, 0.0F);
  EXPECT_GT(color.x(), 200.0F);
  EXPECT_LT(color.y(), 60.0F);
  EXPECT_LT(color.z(), 60.0F);
}

TEST(LoadWorld, WordsOfTheCommandLineAreUnderstood) {
  EXPECT_EQ(*ParseUpAxis("y"), UpAxis::kY);
  EXPECT_EQ(*ParseUpAxis("z"), UpAxis::kZ);
  EXPECT_FALSE(ParseUpAxis("x"));
  EXPECT_EQ(*ParseGroundMode("flat"), GroundMode::kFlat);
  EXPECT_EQ(*ParseGroundMode("mesh"), GroundMode::kMesh);
  EXPECT_FALSE(ParseGroundMode("sea"));
}

TEST(LoadWorld, BookstoreCanBeStoodInAndSeen) {
  const std::filesystem::path folder =
      std::filesystem::path(SourceDir()) / ".." / "shared" / "worlds" / "bookstore";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not on this machine";
  const auto world = LoadWorld({folder / "world.obj"});
  ASSERT_TRUE(world) << world.error().message;
  EXPECT_THAT((*world)->warnings(), SizeIs(0));
  const auto path = ReadPath(folder / "path.csv");
  ASSERT_TRUE(path) << path.error().message;
  for (const Eigen::Vector2d& point : path->points) {
    EXPECT_NEAR((*world)->FloorHeight(point.x(), point.y()).value_or(99.0), 0.0, 0.02);
  }
  SimulatedRobotOptions options;
  options.camera = *FindCamera("webcam");
  options.start = StartPose(path->points);
  auto robot = SimulatedRobot::Create(*world, options);
  ASSERT_TRUE(robot) << robot.error().message;
  const auto picture = (*robot)->Step({}).image;
  const auto [darkest, brightest] =
      std::minmax_element(picture.pixels.begin(), picture.pixels.end());
  EXPECT_GT(*brightest - *darkest, 120);
}

}  // namespace
}  // namespace trailcast::sim
