#pragma once

// What JSON leaves to its readers: a key twice in one object, brackets inside each other without end. Found
// by a pass of its own, in linear time; the library's own callback looks at all elements of an array again
// after each of them, so that a list of 100,000 objects would take seconds.

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace remodel {

// Watch has too_deep() and repeated(key), which throw. A text that is no JSON is left to whoever parses it.
template <class Json, class Watch>
class StrictJson : public nlohmann::json_sax<Json> {
 public:
  static constexpr int deepest_nesting = 64;  // printing and copying of values recurse

  explicit StrictJson(Watch watch) : watch_(std::move(watch)) {}

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(typename Json::number_integer_t) override { return true; }
  bool number_unsigned(typename Json::number_unsigned_t) override { return true; }
  bool number_float(typename Json::number_float_t, const typename Json::string_t&) override { return true; }
  bool string(typename Json::string_t&) override { return true; }
  bool binary(typename Json::binary_t&) override { return true; }
  bool start_object(std::size_t) override {
    enter();
    keys_.emplace_back();
    return true;
  }
  bool key(typename Json::string_t& name) override {
    if (!keys_.back().insert(name).second) watch_.repeated(name);
    return true;
  }
  bool end_object() override {
    keys_.pop_back();
    --depth_;
    return true;
  }
  bool start_array(std::size_t) override {
    enter();
    return true;
  }
  bool end_array() override {
    --depth_;
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;
  }

 private:
  void enter() {
    if (depth_++ > deepest_nesting) watch_.too_deep();
  }

  Watch watch_;
  int depth_ = 0;
  std::vector<std::set<std::string>> keys_;  // of the objects that are open
};

}  // namespace remodel
