#include "phase/crystal/face_path.h"

#include <gtest/gtest.h>

namespace arcus::phase {

TEST(FacePath, IsItsText) {
  const FacePath path = FacePath().then(3).then(1).then(28);
  EXPECT_EQ(path.text(), "3-1-28");
  EXPECT_EQ(path.length(), 3);
  EXPECT_EQ(path.face(0), 3);
  EXPECT_EQ(path.face(2), 28);
  EXPECT_EQ(FacePath::from_text("3-1-28"), path);
  EXPECT_EQ(FacePath::from_text("3"), FacePath().then(3));
  EXPECT_EQ(FacePath(path.code()), path);
}

TEST(FacePath, KeepsTwelveFaces) {
  FacePath path;
  for (int i = 1; i <= 12; ++i) path = path.then(i);
  EXPECT_FALSE(path.longer());
  EXPECT_EQ(path.text(), "1-2-3-4-5-6-7-8-9-10-11-12");
  const FacePath longer = path.then(31);
  EXPECT_TRUE(longer.longer());
  EXPECT_EQ(longer.then(4), longer);
  EXPECT_EQ(longer.length(), 12);
  EXPECT_EQ(longer.text(), path.text() + "...");
  EXPECT_EQ(FacePath::from_text(longer.text()), longer);
}

TEST(FacePath, RefusesOtherText) {
  for (const char* text :
       {"", "-", "3-", "-3", "3--5", "0", "32", "3,5", "a", "3-5...", "1-1-1-1-1-1-1-1-1-1-1-1-1"})
    EXPECT_FALSE(FacePath::from_text(text)) << text;
}

}  // namespace arcus::phase
