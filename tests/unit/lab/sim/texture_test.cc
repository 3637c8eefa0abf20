#include "services/lab/sim/core/texture.h"

#include <gtest/gtest.h>

#include <limits>

namespace trailcast::sim {
namespace {

// Four texels: black, white / white, black.
const image::RgbImage kChecker = {2, 2, {0, 0, 0, 255, 255, 255, 255, 255, 255, 0, 0, 0}};

TEST(Texture, TexelCentresHaveTheTexelsValues) {
  const Texture texture(kChecker);
  EXPECT_NEAR(texture.Gray(0.25F, 0.25F, 0.0F), 0.0F, 0.5F);
  EXPECT_NEAR(texture.Gray(0.75F, 0.25F, 0.0F), 255.0F, 0.5F);
  EXPECT_NEAR(texture.Gray(0.5F, 0.25F, 0.0F), 127.5F, 1.0F);
}

TEST(Texture, RepeatsInBothDirections) {
  const Texture texture(kChecker);
  for (const float shift : {-3.0F, -1.0F, 1.0F, 7.0F}) {
    EXPECT_NEAR(texture.Gray(0.75F + shift, 0.25F, 0.0F), 255.0F, 0.5F);
    EXPECT_NEAR(texture.Gray(0.25F, 0.25F - shift, 0.0F), 0.0F, 0.5F);
  }
}

TEST(Texture, CoarsestLevelIsTheAverageAndBeyondItNothingChanges) {
  const Texture texture(kChecker);
  EXPECT_NEAR(texture.Gray(0.1F, 0.9F, 1.0F), 127.5F, 1.0F);
  EXPECT_NEAR(texture.Gray(0.1F, 0.9F, 30.0F), 127.5F, 1.0F);
  EXPECT_NEAR(texture.Gray(0.25F, 0.25F, 0.5F), 64.0F, 1.5F);
}

TEST(Texture, OddSizesKeepTheirAverage) {
  image::RgbImage picture{5, 3, std::vector<std::uint8_t>(45, 0)};
  for (std::size_t i = 0; i < 45; ++i) picture.pixels[i] = 90;
  const Texture texture(picture);
  EXPECT_NEAR(texture.Gray(0.3F, 0.3F, 10.0F), 90.0F, 0.5F);
}

TEST(Texture, ColoursKeepTheirChannels) {
  const Texture texture(image::RgbImage{1, 1, {200, 100, 50}});
  EXPECT_TRUE(texture.Rgb(0.2F, 0.7F, 0.0F).isApprox(Eigen::Vector3f(200, 100, 50)));
}

TEST(Texture, FarCoordinatesStayInsideThePicture) {
  const Texture texture(kChecker);
  for (const float far : {1e9F, -1e9F, std::numeric_limits<float>::infinity()}) {
    const float value = texture.Gray(far, -far, 0.0F);
    EXPECT_GE(value, 0.0F);
    EXPECT_LE(value, 255.0F);
  }
}

}  // namespace
}  // namespace trailcast::sim
