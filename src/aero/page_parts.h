#pragma once

// What pages of results are made of: one file each, with everything in it.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace remodel {

std::string number(double value, const char* format = "%.4g");
std::string escaped(const std::string& text);
// Rows and cells of tables.
std::string row(const std::string& name, const std::string& value);
std::string cells(const std::vector<std::string>& texts);
// To the beginning of the body.
std::string page_head(const std::string& title);

// A directory that is gone with everything in it when this is.
class Scratch {
 public:
  Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch();
  // What `write` makes of a file of this extension, as the source of an image.
  std::string picture(const char* extension,
                      const std::function<void(const std::filesystem::path&)>& write) const;

 private:
  std::filesystem::path path_;
};

}  // namespace remodel
