#include "services/lab/trial/align/src/alignment_path.h"

#include <gmock/gmock.h>

namespace trailcast::trial {
namespace {

using testing::ElementsAre;

// So many inliers with one taught picture, and by chance as many as usual with all others.
std::vector<Candidate> Sees(int teach, int inliers, int taught = 20) {
  std::vector<Candidate> row;
  for (int i = 0; i < taught; ++i) row.push_back({i, i == teach ? inliers : 9});
  return row;
}

std::vector<int> Trace(const std::vector<std::vector<Candidate>>& rows) {
  AlignmentPath path;
  for (const auto& row : rows) path.Add(row);
  std::vector<int> teach;
  for (const Candidate& candidate : path.Trace()) teach.push_back(candidate.teach);
  return teach;
}

TEST(AlignmentPath, NothingHasNoWay) { EXPECT_TRUE(AlignmentPath().Trace().empty()); }

TEST(AlignmentPath, GoesWhereThePicturesAre) {
  EXPECT_THAT(Trace({Sees(3, 40), Sees(4, 40), Sees(6, 40), Sees(6, 40)}), ElementsAre(3, 4, 6, 6));
}

TEST(AlignmentPath, OnePictureThatLooksLikeElsewhereIsNoJump) {
  EXPECT_THAT(Trace({Sees(3, 40), Sees(4, 40), Sees(17, 60), Sees(6, 40), Sees(7, 40)}),
              ElementsAre(3, 4, testing::AllOf(testing::Ge(4), testing::Le(6)), 6, 7));
}

TEST(AlignmentPath, ALapEndsAndBeginsAgain) {
  EXPECT_THAT(Trace({Sees(16, 60), Sees(17, 60), Sees(18, 60), Sees(19, 60), Sees(0, 60),
                     Sees(1, 60), Sees(2, 60), Sees(3, 60)}),
              ElementsAre(16, 17, 18, 19, 0, 1, 2, 3));
}

TEST(AlignmentPath, ALittleBackIsCheaperThanAJump) {
  EXPECT_THAT(Trace({Sees(10, 40), Sees(11, 40), Sees(10, 40), Sees(9, 40)}),
              ElementsAre(10, 11, 10, 9));
}

TEST(AlignmentPath, KnowsItsBestWaySoFar) {
  AlignmentPath path;
  path.Add(Sees(5, 40));
  EXPECT_EQ(path.Best().teach, 5);
  path.Add(Sees(6, 40));
  EXPECT_EQ(path.Best().teach, 6);
  EXPECT_EQ(path.Best().inliers, 40);
}

TEST(AlignmentPath, CandidatesMayBeFew) {
  EXPECT_THAT(Trace({{{7, 30}}, {{7, 12}, {8, 30}}, {{15, 20}, {9, 30}}}), ElementsAre(7, 8, 9));
}

}  // namespace
}  // namespace trailcast::trial
