#include "remodel/error.h"

#include <gtest/gtest.h>

namespace remodel {
namespace {

using namespace std::string_literals;

std::string message(const std::string& where, const std::string& problem) {
  return Error(ErrorCode::format, where, problem).what();
}

TEST(Error, ShowsPlainTextAsItIs) {
  EXPECT_EQ(message("wing.dat:3", "found 'x', expected a number"),
            "wing.dat:3: found 'x', expected a number");
  EXPECT_EQ(one_line("Flügel/翼.dat: 100 % \\t"), "Flügel/翼.dat: 100 % \\t");
}

TEST(Error, EscapesControlCharactersAndSaysWhatFollowsThem) {
  EXPECT_EQ(message("a\0b.dat"s, "found '\t\n\x1b[31m\x7f'"), "a\\x00b.dat: found '\\t\\n\\x1b[31m\\x7f'");
  EXPECT_EQ(one_line("\u009b31m"), "\\xc2\\x9b31m");  // a control character beyond ASCII
}

TEST(Error, EscapesWhatIsNoUtf8) {
  EXPECT_EQ(one_line("Fl\xfcgel"), "Fl\\xfcgel");
  EXPECT_EQ(one_line("\xc0\xaf \xed\xa0\x80 \xf5\x80\x80\x80 \xe7"),
            "\\xc0\\xaf \\xed\\xa0\\x80 \\xf5\\x80\\x80\\x80 \\xe7");
}

TEST(Error, ShortensLongWordsInTheMiddle) {
  const std::string path = "/" + std::string(159, 'p');
  EXPECT_EQ(one_line(path), path);
  EXPECT_EQ(message("a.json", "found '" + std::string(10'000'000, 'x') + "', expected a name"),
            "a.json: found '" + std::string(39, 'x') + "..." + std::string(38, 'x') + "', expected a name");
}

TEST(Error, ShortensLongTextsInTheMiddleBetweenCharacters) {
  std::string many;
  for (int i = 0; i < 1'000'000; ++i) many += "ä ";
  const std::string line = one_line("found '" + many + "', expected a name");
  EXPECT_LE(line.size(), 803U);
  EXPECT_TRUE(line.starts_with("found 'ä ä ")) << line;
  EXPECT_TRUE(line.ends_with("', expected a name")) << line;
  EXPECT_EQ(line.find("\\x"), std::string::npos) << line;
  std::string word;
  for (int i = 0; i < 1000; ++i) word += "翼";
  EXPECT_EQ(one_line(one_line(word)), one_line(word));
  EXPECT_EQ(one_line(word).find("\\x"), std::string::npos);
}

}  // namespace
}  // namespace remodel
