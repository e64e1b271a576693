#include "phase/settings/toml_text.h"

#include <gtest/gtest.h>

#include "phase/base/error.h"
#include "phase/settings/reference.h"

namespace arcus {
namespace {

struct Lamp {
  double power_w = 60;
  std::string colour = "white";
};
void list_keys(Keys& keys, Lamp& lamp) {
  keys.number("power_w", lamp.power_w, at_least(0), "power");
  keys.choice("colour", lamp.colour, {"white", "yellow"}, "colour");
}

struct Room {
  double height_m = 2.5;
  long long doors = 1;
  bool lit = false;
  Vec3 centre_m{0, 0, 0};
  std::vector<double> sizes{1};
  std::string material_name = "wood";
  Lamp material;
  Lamp main;
  std::vector<Lamp> lamps;
};
void list_keys(Keys& keys, Room& room) {
  keys.number("height_m", room.height_m, above(0), "height");
  keys.integer("doors", room.doors, between(0, 10), "doors");
  keys.flag("lit", room.lit, "lit");
  keys.vector3("centre_m", room.centre_m, "centre");
  keys.nodes("sizes", room.sizes, above(0), Spacing::logarithmic, "sizes");
  keys.word_or_table("material", room.material_name, room.material, "material");
  keys.table("main", room.main, "main lamp");
  keys.tables("lamp", room.lamps, "lamps");
}

std::string message_of(std::string_view text) {
  try {
    settings_from_text<Room>(text, "room.toml");
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  return "no error";
}

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST(TomlText, ReadsEveryKindOfKey) {
  const Room room = settings_from_text<Room>(
      "height_m = 3\ndoors = 2\nlit = true\ncentre_m = [1, 2.5, 3]\nsizes = { min = 1, max = 100, nodes = 3 }\n"
      "material = { power_w = 1 }\n[main]\npower_w = 5\n[[lamp]]\n[[lamp]]\ncolour = 'yellow'\n",
      "room.toml");
  EXPECT_EQ(room.height_m, 3);
  EXPECT_EQ(room.doors, 2);
  EXPECT_TRUE(room.lit);
  EXPECT_EQ(room.centre_m.y, 2.5);
  ASSERT_EQ(room.sizes.size(), 3u);
  EXPECT_NEAR(room.sizes[1], 10, 1e-12);
  EXPECT_TRUE(room.material_name.empty());
  EXPECT_EQ(room.material.power_w, 1);
  EXPECT_EQ(room.main.power_w, 5);
  ASSERT_EQ(room.lamps.size(), 2u);
  EXPECT_EQ(room.lamps[1].colour, "yellow");
}

TEST(TomlText, UnknownKeySuggestsTheNearestNameAndSaysWhere) {
  const std::string message = message_of("doors = 2\n[main]\npower = 5\n");
  EXPECT_TRUE(contains(message, "room.toml:3:1")) << message;
  EXPECT_TRUE(contains(message, "main.power")) << message;
  EXPECT_TRUE(contains(message, "Did you mean 'power_w'")) << message;
}

TEST(TomlText, RangeAndTypeErrorsSayWhatWasFoundAndExpected) {
  EXPECT_EQ(message_of("height_m = -0.5\n"), "room.toml:1:12: height_m: -0.5 found; must be above 0");
  EXPECT_TRUE(contains(message_of("height_m = nan\n"), "must be above 0"));
  EXPECT_TRUE(contains(message_of("doors = 1.5\n"), "whole number"));
  EXPECT_TRUE(contains(message_of("centre_m = [1, 2]\n"), "must be [x, y, z]"));
  EXPECT_TRUE(contains(message_of("[main]\ncolour = 'whit'\n"), "Did you mean 'white'"));
  EXPECT_TRUE(contains(message_of("sizes = [3, 2]\n"), "ascending"));
  EXPECT_TRUE(contains(message_of("height_m = = 2\n"), "room.toml:1"));
}

TEST(TomlText, OverridesReachTablesAndEntriesOfArrays) {
  Room room;
  const std::vector<std::string> overrides{"main.power_w=7", "lamp.0.colour=yellow", "doors=3"};
  read_toml("[[lamp]]\n", "room.toml", overrides, [&](Keys& keys) { list_keys(keys, room); });
  EXPECT_EQ(room.main.power_w, 7);
  EXPECT_EQ(room.lamps.at(0).colour, "yellow");
  EXPECT_EQ(room.doors, 3);
  const std::vector<std::string> wrong{"main.powr_w=7"};
  EXPECT_THROW(read_toml("", "room.toml", wrong, [&](Keys& keys) { list_keys(keys, room); }), Error);
}

TEST(TomlText, WritingAndReadingGivesTheSameText) {
  Room room;
  room.height_m = 1.0 / 3;
  room.material_name.clear();
  room.lamps.resize(2);
  const std::string text = text_of(room);
  EXPECT_EQ(text_of(settings_from_text<Room>(text, "copy")), text);
}

TEST(Reference, NamesEveryKeyWithItsDefault) {
  Room room;
  const std::string page = reference_page("Room", [&](Keys& keys) { list_keys(keys, room); });
  for (const char* key : {"`height_m` | 2.5", "`main.power_w` | 60", "`lamp.colour` | \"white\"", "`material.power_w`"})
    EXPECT_TRUE(contains(page, key)) << key << " in\n" << page;
}

TEST(Reference, SchemaHasBalancedBracketsAndEveryKey) {
  Room room;
  const std::string schema = json_schema("Room", [&](Keys& keys) { list_keys(keys, room); });
  EXPECT_EQ(std::count(schema.begin(), schema.end(), '{'), std::count(schema.begin(), schema.end(), '}')) << schema;
  for (const char* key : {"\"height_m\"", "\"power_w\"", "\"exclusiveMinimum\": 0", "\"enum\": [\"white\""})
    EXPECT_TRUE(contains(schema, key)) << key;
}

}  // namespace arcus
