#include "base/config/config_section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

#include "tests/unit/error_text.h"

namespace ols::config {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

enum class Colour { kRed, kBlue };

struct Wheel {
  double radius_m = 0.5;
};

struct Cart {
  double length_m = 2.0;
  std::int64_t seats = 1;
  bool open = false;
  std::string name;
  Colour colour = Colour::kBlue;
  std::vector<Colour> stripes{Colour::kRed};
  std::array<double, 2> axle_m{0.25, 1.5};
  double limit_bytes = 3e6;
  int sign = 1;
  std::string host;
  std::vector<Wheel> wheels;
};

const Words<Colour> kColours{{"red", Colour::kRed}, {"blue", Colour::kBlue}};

Section cart_section(Cart& c) {
  Section wheel{"wheel", "A wheel."};
  wheel.append = [&c] {
    return Section{
        "", "", {number("radius_m", c.wheels.emplace_back().radius_m, {0, 5}, "m", "Its radius.")}};
  };
  return {"cart",
          "A cart.",
          {text("name", c.name, "Its name.", not_empty).required(),
           number("length_m", c.length_m, {0, 10}, "m", "From end | to end."),
           integer("seats", c.seats, 0, 9, "", "For people."), flag("open", c.open, "No roof."),
           word("colour", c.colour, kColours, "Of all of it."),
           word_list("stripes", c.stripes, kColours, "Their colours."),
           numbers("axle_m", c.axle_m, {-5, 5}, "m", "Where the axle is."),
           number("limit_mb", c.limit_bytes, {1, 10}, kMegabytes, "What it carries."),
           one_of("sign", c.sign, {1, -1}, "", "Which way.")},
          {wheel, {"radio", "A radio.", {text("host", c.host, "Where.").required_with_section()}}},
          [&c](ConfigTable& table) {
            if (c.seats > 5 && c.length_m < 3.0) throw table.error("seats", "do not fit");
          }};
}

Cart loaded(const std::string& toml) {
  Cart cart;
  ConfigFile file(toml, "f");
  read(cart_section(cart), file.root());
  return cart;
}

std::string cart_error(const std::string& toml) {
  return error_text<ConfigError>([&] { loaded(toml); }, "none");
}

TEST(ConfigSection, ReadsEachKindOfRow) {
  const Cart c = loaded(
      "name = 'a'\nlength_m = 4\nseats = 3\nopen = true\ncolour = 'red'\n"
      "stripes = ['blue', 'red']\naxle_m = [1, 2]\nlimit_mb = 7\nsign = -1\n"
      "radio.host = 'h'\n[[wheel]]\nradius_m = 1\n[[wheel]]\n");
  EXPECT_EQ(c.length_m, 4.0);
  EXPECT_EQ(c.seats, 3);
  EXPECT_TRUE(c.open);
  EXPECT_EQ(c.colour, Colour::kRed);
  EXPECT_THAT(c.stripes, ElementsAre(Colour::kBlue, Colour::kRed));
  EXPECT_THAT(c.axle_m, ElementsAre(1.0, 2.0));
  EXPECT_EQ(c.limit_bytes, 7e6);
  EXPECT_EQ(c.sign, -1);
  EXPECT_EQ(c.host, "h");
  ASSERT_EQ(c.wheels.size(), 2u);
  EXPECT_EQ(c.wheels[0].radius_m, 1.0);
  EXPECT_EQ(c.wheels[1].radius_m, 0.5);
}

TEST(ConfigSection, FieldsKeepTheirDefaults) {
  const Cart c = loaded("name = 'a'\n"), fresh;
  EXPECT_EQ(c.length_m, fresh.length_m);
  EXPECT_EQ(c.seats, fresh.seats);
  EXPECT_EQ(c.colour, fresh.colour);
  EXPECT_EQ(c.stripes, fresh.stripes);
  EXPECT_EQ(c.axle_m, fresh.axle_m);
  EXPECT_EQ(c.limit_bytes, fresh.limit_bytes);
  EXPECT_TRUE(c.wheels.empty());
}

TEST(ConfigSection, RefusesNamingLineAndKey) {
  EXPECT_EQ(cart_error("name = 'a'\nsaets = 3\n"), "f:2: saets: unknown key; did you mean seats?");
  EXPECT_EQ(cart_error("name = 'a'\n[weel]\n"), "f:2: weel: unknown key; did you mean wheel?");
  EXPECT_EQ(cart_error("naem = 'a'\n"), "f:1: naem: unknown key; did you mean name?")
      << "before the one that is missing";
  EXPECT_EQ(cart_error("name = 'a'\nradio.hots = 'h'\n"),
            "f:2: radio.hots: unknown key; did you mean host?");
  EXPECT_EQ(cart_error("seats = 3\n"), "f:1: name: is missing");
  EXPECT_EQ(cart_error("name = ''\n"), "f:1: name: must not be empty");
  EXPECT_EQ(cart_error("name = 'a'\n[radio]\n"), "f:2: radio.host: is missing");
  EXPECT_EQ(cart_error("name = 'a'\n[[wheel]]\nradius_m = 6\n"),
            "f:3: wheel[0].radius_m: 6 is outside 0..5");
  EXPECT_EQ(cart_error("name = 'a'\nlimit_mb = 0.5\n"), "f:2: limit_mb: 0.5 is outside 1..10");
  EXPECT_EQ(cart_error("name = 'a'\nsign = 0\n"), "f:2: sign: 0 is not one of 1, -1");
  EXPECT_EQ(cart_error("name = 'a'\ncolour = 'green'\n"),
            "f:2: colour: \"green\" is not one of red, blue");
  EXPECT_EQ(cart_error("name = 'a'\nstripes = ['r\"\\e']\n"),
            R"(f:2: stripes: "r\"\\e" is not one of red, blue)");
  EXPECT_EQ(cart_error("name = 'a'\nstripes = []\n"), "f:2: stripes: needs at least one entry");
  EXPECT_EQ(cart_error("name = 'a'\nseats = 6\n"), "f:2: seats: do not fit");
}

TEST(ConfigSection, TheReferenceHasARowForEachKey) {
  Cart cart;
  const std::string text = markdown(cart_section(cart));
  EXPECT_THAT(text, HasSubstr("### `[cart]`\n\nA cart.\n"));
  EXPECT_THAT(text, HasSubstr("| `name` | required | text |  | Its name. |\n"));
  EXPECT_THAT(text, HasSubstr("| `length_m` | 2 | 0 to 10 | m | From end \\| to end. |\n"));
  EXPECT_THAT(text, HasSubstr("| `limit_mb` | 3 | 1 to 10 | MB | What it carries. |\n"));
  EXPECT_THAT(text, HasSubstr("| `colour` | \"blue\" | \"red\", \"blue\" |  | Of all of it. |\n"));
  EXPECT_THAT(text, HasSubstr("| `axle_m` | [0.25, 1.5] | -5 to 5 | m | Where the axle is. |\n"));
  EXPECT_THAT(text, HasSubstr("### `[[cart.wheel]]`\n\nA wheel.\n"));
  EXPECT_THAT(text, HasSubstr("### `[cart.radio]`"));
  EXPECT_THAT(text, HasSubstr("| `host` | required in this section |"));
}

TEST(ConfigSection, AnExampleHasTheValuesAndTheSentences) {
  Cart cart;
  Section section = cart_section(cart);
  section.name = "";
  EXPECT_EQ(example(section, {{"radio.host", "\"h\""}, {"seats", "2"}}),
            "seats = 2  # For people.\n\n[radio]  # A radio.\nhost = \"h\"  # Where.\n");
  EXPECT_THROW(example(section, {{"saets", "2"}}), std::invalid_argument);
}

TEST(ConfigSection, ATextIsEscapedAsTheFileWouldWriteIt) {
  Cart cart;
  cart.name = "a\"\\";
  const Section section{"cart", "A cart.", {text("name", cart.name, "Its name.")}};
  EXPECT_THAT(markdown(section), HasSubstr(R"(| `name` | "a\"\\" |)"));
}

TEST(ConfigSection, SomeRowsCanBePicked) {
  Cart cart;
  const Section all = cart_section(cart);
  const Section some = picked(all, {"length_m"});
  ASSERT_EQ(some.rows.size(), 1U);
  EXPECT_TRUE(some.sections.empty());
  ConfigFile good("length_m = 3.0\n", "t"), bad("length_m = 3.0\nseats = 2\n", "t");
  read(some, good.root());
  EXPECT_EQ(cart.length_m, 3.0);
  EXPECT_THAT(stated(all, bad.root()), ElementsAre("length_m", "seats"));
  EXPECT_THROW(read(some, bad.root()), ConfigError);
  EXPECT_THROW(picked(all, {"length_m", "nothing"}), std::invalid_argument);
}

// A thing of several kinds: the keys depend on it.
struct Engine {
  double power_w = 100.0;
  std::string hay = "meadow";
  std::size_t kind = 0;
};

Section cart_with(Engine& e) {
  Section engine{"engine", "What moves it."};
  engine.former_name = "motor";
  engine.choose = [&e](std::size_t kind) { e.kind = kind; };
  engine.forms = {{"electric",
                   "A motor.",
                   {number("power_w", e.power_w, {0, 1e4}, "W", "Its power.").required()}},
                  {"horse", "An animal.", {text("hay", e.hay, "What it eats.")}}};
  return {"", "", {}, {engine}};
}

std::string trouble_of(const std::string& text) {
  Engine engine;
  return error_text<ConfigError>(
      [&] {
        ConfigFile file(text, "cart.toml");
        read(cart_with(engine), file.root());
      },
      "none");
}

Engine engine_of(const std::string& text) {
  Engine engine;
  ConfigFile file(text, "cart.toml");
  read(cart_with(engine), file.root());
  return engine;
}

TEST(ConfigSection, AKindHasItsOwnKeys) {
  EXPECT_EQ(engine_of("[engine]\nkind = 'horse'\nhay = 'alp'\n").kind, 1U);
  EXPECT_EQ(engine_of("[engine]\nkind = 'horse'\nhay = 'alp'\n").hay, "alp");
  EXPECT_EQ(engine_of("[engine]\npower_w = 7\n").power_w, 7.0) << "the first is the default";
  EXPECT_THAT(trouble_of("[engine]\nkind = 'horse'\npower_w = 7\n"), HasSubstr("engine.power_w"));
  EXPECT_THAT(trouble_of("[engine]\nkind = 'steam'\ncoal = 7\n"), HasSubstr("engine.kind"));
  EXPECT_THAT(trouble_of(""), HasSubstr("engine.power_w: is missing"));
}

TEST(ConfigSection, AFormerNameMeansTheFirstKind) {
  EXPECT_EQ(engine_of("[motor]\npower_w = 7\n").power_w, 7.0);
  EXPECT_EQ(engine_of("[motor]\npower_w = 7\n").kind, 0U);
  EXPECT_THAT(trouble_of("[motor]\nkind = 'horse'\n"), HasSubstr("motor.kind"));
  EXPECT_THAT(trouble_of("[motor]\npower_w = 7\n[engine]\nkind = 'horse'\n"),
              HasSubstr("motor: is the former name of engine"));
}

TEST(ConfigSection, AnExampleIsOfTheKindAndByTheNameThatItsValuesHave) {
  Engine engine;
  EXPECT_EQ(example(cart_with(engine), {{"engine.kind", "\"horse\""}, {"engine.hay", "\"alp\""}}),
            "\n[engine]  # What moves it.\n"
            "kind = \"horse\"  # Its kind, on which the other keys depend.\n"
            "hay = \"alp\"  # What it eats.\n");
  EXPECT_EQ(example(cart_with(engine), {{"motor.power_w", "7"}}),
            "\n[motor]  # What moves it.\npower_w = 7  # Its power.\n");
  EXPECT_THROW(example(cart_with(engine), {{"engine.hay", "\"alp\""}}), std::invalid_argument);
}

TEST(ConfigSection, ThePageHasEachKind) {
  Engine engine;
  const std::string page = markdown(cart_with(engine));
  EXPECT_THAT(page, HasSubstr("| `kind` | \"electric\" | \"electric\", \"horse\" |"));
  EXPECT_THAT(page, HasSubstr("#### `[engine]` with `kind = \"horse\"`\n\nAn animal.\n"));
  EXPECT_THAT(page, HasSubstr("`[motor]` is still read, as `electric`."));
}

TEST(ConfigSection, KeysOfAKindCanBePickedAlone) {
  Engine engine;
  ConfigFile file("[motor]\npower_w = 9\n", "site.toml");
  const Section section = picked(cart_with(engine), {"engine.power_w"});
  read(section, file.root());
  EXPECT_EQ(engine.power_w, 9.0);
  EXPECT_THAT(stated(section, file.root()), ElementsAre("engine.power_w"));
}

}  // namespace
}  // namespace ols::config
