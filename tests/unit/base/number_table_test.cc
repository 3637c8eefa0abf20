#include "services/base/number_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/support/temp_dir.h"

namespace trailcast {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class NumberTableTest : public testing::Test {
 protected:
  Result<std::vector<NumberRow>> Read(const std::string& text) {
    std::ofstream(folder_ / "table.csv") << text;
    return ReadNumbers(folder_ / "table.csv", {"b", "a"}, {"c"});
  }
  std::string ErrorOf(const std::string& text) {
    const auto read = Read(text);
    return read ? "no error" : read.error().message;
  }
  test::TempDir folder_;
};

TEST_F(NumberTableTest, ColumnsAreFoundByNameAndOthersLeftOut) {
  const auto rows = Read("a, b ,other\r\n1,2,x\r\n\r\n3, 4e-1,y\r\n");
  ASSERT_TRUE(rows) << rows.error().message;
  ASSERT_EQ(rows->size(), 2U);
  EXPECT_THAT((*rows)[0].cells, ElementsAre(2.0, 1.0));
  EXPECT_THAT((*rows)[1].cells, ElementsAre(0.4, 3.0));
  EXPECT_EQ((*rows)[1].line, 4);
}

TEST_F(NumberTableTest, OptionalColumnsComeLast) {
  const auto rows = Read("c,a,b\n9,1,2\n");
  ASSERT_TRUE(rows) << rows.error().message;
  EXPECT_THAT((*rows)[0].cells, ElementsAre(2.0, 1.0, 9.0));
}

TEST_F(NumberTableTest, WhatIsWrongIsToldByLine) {
  EXPECT_THAT(ErrorOf(""), AllOf(HasSubstr("line 1"), HasSubstr("b,a"), HasSubstr("it is empty")));
  EXPECT_THAT(ErrorOf("a,c\n1,2\n"), AllOf(HasSubstr("line 1"), HasSubstr("it has a,c")));
  EXPECT_THAT(ErrorOf("a,b\n1,2\n1\n"), AllOf(HasSubstr("line 3"), HasSubstr("1 columns")));
  EXPECT_THAT(ErrorOf("a,b\n1,two\n"), AllOf(HasSubstr("line 2"), HasSubstr("'two'")));
  EXPECT_THAT(ErrorOf("a,b\n1,inf\n"), HasSubstr("line 2"));
  EXPECT_EQ(ReadNumbers("/nowhere.csv", {"a"}).error().code, ErrorCode::kNotFound);
  EXPECT_THAT(ReadNumbers("/usr", {"a"}).error().message,
              AllOf(HasSubstr("/usr"), HasSubstr("is it a file")));
}

}  // namespace
}  // namespace trailcast
