#include "triangulation/slot_array.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace remodel {
namespace {

struct alignas(64) Record {
  std::uint64_t value = 7;
};

// Past the size where arrays leave the heap, and once more where their pages move.
TEST(SlotArray, KeepsItsRecordsWhileItGrows) {
  SlotArray<Record> records;
  constexpr std::size_t count = std::size_t{1} << 20;
  for (std::size_t i = 0; i < count; ++i) {
    records.push_back({i});
    ASSERT_EQ(reinterpret_cast<std::uintptr_t>(&records[i]) % alignof(Record), 0U);
  }
  ASSERT_EQ(records.size(), count);
  for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(records[i].value, i);
  const SlotArray<Record> copy = records;
  records.truncate(3);
  EXPECT_EQ(records.size(), 3U);
  EXPECT_EQ(copy.size(), count);
  EXPECT_EQ(copy[count - 1].value, count - 1);
}

TEST(SlotArray, TakesARecordOfItsOwn) {
  SlotArray<Record> records;
  records.push_back({1});
  for (int i = 0; i < 1000; ++i) records.push_back(records[0]);
  for (const Record& record : records) EXPECT_EQ(record.value, 1U);
}

TEST(SlotArray, IsMovedAndCopied) {
  SlotArray<std::uint32_t> a;
  a.push_back(1);
  SlotArray<std::uint32_t> b = std::move(a);
  ASSERT_EQ(b.size(), 1U);
  a = b;
  b.push_back(2);
  EXPECT_EQ(a.size(), 1U);
  EXPECT_EQ(b.size(), 2U);
  a = SlotArray<std::uint32_t>();
  EXPECT_TRUE(a.empty());
}

}  // namespace
}  // namespace remodel
