#include "core/hdf5_file.hpp"
#include "core/hdf5_writer.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>
#include <hdf5_hl.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>

#include "scene/input_error.hpp"

namespace eigentrail::test::hdf5_file_test {
namespace {

class Hdf5FileTest : public testing::Test {
 protected:
  /// A file of this test alone, since tests run at the same time.
  static std::string path_of(const std::string& ending) {
    return testing::TempDir() + "eigentrail_" +
           testing::UnitTest::GetInstance()->current_test_info()->name() + ending;
  }
  void TearDown() override { std::filesystem::remove(path); }

  const std::string path = path_of(".h5");
};

DatasetSpec fixed(const std::string& name, ElementType type, const Shape& shape) {
  return {name, type, shape, false, {}};
}

DatasetSpec growing(const std::string& name, ElementType type, const Shape& shape) {
  return {name, type, shape, true, {}};
}

Hdf5File read_back(Hdf5Writer& file) {
  return Hdf5File::from_image("file", file.image());
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Calls HDF5 on a file that is open for writing.
void with_hdf5(const std::string& path, const std::function<void(hid_t)>& use) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  use(file);
  ASSERT_GE(H5Fclose(file), 0);
}

TEST_F(Hdf5FileTest, RealNumbersSurviveARoundTripBitForBit) {
  const std::vector<double> data = {1.0 / 3.0, -0.0, std::numbers::pi, 1e-308, -1e308, INFINITY};
  {
    Hdf5Writer file = Hdf5Writer::create(path);
    file.create_dataset(fixed("x", ElementType::real, {2, 3}));
    file.write_rows("x", 0, data);
  }
  const Hdf5File file = Hdf5File::open(path);
  EXPECT_EQ(file.shape("x"), (Shape{2, 3}));
  EXPECT_EQ(file.read_real("x"), data);
}

/// MATLAB and NumPy write texts of fixed length, and MATLAB every number as a real one.
TEST_F(Hdf5FileTest, TextsOfFixedLengthAndWholeRealNumbersAreRead) {
  (void)Hdf5Writer::create(path);
  with_hdf5(path, [](hid_t file) {
    const hid_t padded = H5Tcopy(H5T_C_S1);
    H5Tset_size(padded, 6);
    H5Tset_strpad(padded, H5T_STR_SPACEPAD);
    const hsize_t two = 2;
    const hid_t space = H5Screate_simple(1, &two, nullptr);
    const hid_t names = H5Dcreate2(file, "names", padded, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(names, padded, H5S_ALL, H5S_ALL, H5P_DEFAULT, "a b   sixsix");
    H5Dclose(names);
    H5Sclose(space);
    H5Tclose(padded);
    H5LTset_attribute_string(file, "/", "order", "columns");
    const std::array<double, 2> numbers{4.0, 4.5};
    H5LTset_attribute_double(file, "/", "digits", numbers.data(), 1);
    H5LTset_attribute_double(file, "/", "half", numbers.data() + 1, 1);
  });
  const Hdf5File file = Hdf5File::open(path);
  EXPECT_EQ(file.read_texts("names"), (std::vector<std::string>{"a b", "sixsix"}));
  EXPECT_EQ(file.text_attribute("order"), "columns");
  EXPECT_EQ(file.integer_attribute("digits"), 4);
  EXPECT_TRUE(contains(error_text<Hdf5Error>([&] { (void)file.integer_attribute("half"); }),
                       "attribute half: expected whole numbers"));
}

TEST_F(Hdf5FileTest, FileInMemoryGoesOnFromItsImage) {
  Hdf5Writer first = Hdf5Writer::in_memory("same name");
  Hdf5Writer second = Hdf5Writer::in_memory("same name");
  DatasetSpec spec = fixed("x", ElementType::real, {0});
  spec.growing = true;
  first.create_dataset(spec);
  first.write_rows("x", 0, std::vector<double>{1.0, 2.0});
  Hdf5Writer again = Hdf5Writer::from_image("again", first.image() + "what stands behind is passed over");
  again.write_rows("x", 2, std::vector<double>{3.0});
  EXPECT_EQ(read_back(again).read_real("x"), (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(read_back(first).read_real("x"), (std::vector<double>{1.0, 2.0}));
  EXPECT_FALSE(read_back(second).has("x"));
  std::ofstream(path, std::ios::binary) << again.image();
  EXPECT_EQ(Hdf5File::open(path).read_real("x").size(), 3u);
  EXPECT_THROW(Hdf5Writer::from_image("none", "no HDF5 file"), Hdf5Error);
  EXPECT_EQ(error_text<Hdf5Error>([] { Hdf5File::from_image("none", "text"); }),
            "none: cannot be read: HDF5 could not open it: it is no HDF5 file, or damaged: file signature "
            "not found");
}

TEST_F(Hdf5FileTest, IntegersAreStoredAsIntegersOf64Bits) {
  const std::vector<std::int64_t> data = {0, -7, std::int64_t{1} << 40, INT64_MIN};
  {
    Hdf5Writer file = Hdf5Writer::create(path);
    file.create_dataset(fixed("n", ElementType::integer, {4}));
    file.write_rows("n", 0, data);
  }
  with_hdf5(path, [&data](hid_t file) {
    std::vector<std::int64_t> stored(4);
    ASSERT_GE(H5LTread_dataset(file, "n", H5T_NATIVE_INT64, stored.data()), 0);
    EXPECT_EQ(stored, data);
  });
  EXPECT_EQ(Hdf5File::open(path).read_real("n")[2], 1099511627776.0);
  EXPECT_EQ(Hdf5File::open(path).read_integers("n"), data);
}

TEST_F(Hdf5FileTest, TextsOfAnyLengthAndScriptSurviveARoundTrip) {
  const std::vector<std::string> data = {"", "pendulum", "Träger µ·²", std::string(100000, 'x')};
  {
    Hdf5Writer file = Hdf5Writer::create(path);
    file.create_dataset(fixed("names", ElementType::text, {4}));
    file.write_rows("names", 0, data);
  }
  EXPECT_EQ(Hdf5File::open(path).read_texts("names"), data);
}

/// As in the file of a short trace: what surrounds the values may not be many times as large as they are.
TEST_F(Hdf5FileTest, GrowingDatasetsOfFewRowsTakeLittleSpace) {
  constexpr std::size_t datasets = 40;
  Hdf5Writer file = Hdf5Writer::in_memory("file");
  for (std::size_t i = 0; i < datasets; ++i) {
    const std::string name = "x" + std::to_string(i);
    file.create_dataset(growing(name, ElementType::real, {0, 2}));
    file.write_rows(name, 0, std::vector<double>(40, 1.0));
  }
  EXPECT_LT(file.image().size(), datasets * 2048);
}

TEST_F(Hdf5FileTest, RowsCanBeWrittenAgainWithoutGrowing) {
  Hdf5Writer file = Hdf5Writer::create(path);
  file.create_dataset(growing("p", ElementType::real, {0, 2}));
  file.write_rows("p", 0, std::vector<double>{1, 2, 3, 4, 5, 6});
  file.write_rows("p", 1, std::vector<double>{30, 40});
  EXPECT_EQ(read_back(file).read_real("p"), (std::vector<double>{1, 2, 30, 40, 5, 6}));
}

TEST_F(Hdf5FileTest, ExtendedDatasetsKeepTheirDataAndReadAsNothingWhereTheyAreNew) {
  {
    Hdf5Writer file = Hdf5Writer::create(path);
    file.create_dataset(growing("x", ElementType::real, {0, 2}));
    file.create_dataset(growing("s", ElementType::complex, {0, 1}));
    file.create_dataset(growing("n", ElementType::integer, {0, 2}));
    file.write_rows("x", 0, std::vector<double>{1.0, 2.0, 3.0, 4.0});
    file.write_rows("s", 0, std::vector<Complex>{{1.0, 2.0}});
    file.write_rows("n", 0, std::vector<std::int64_t>{5, 6});
    file.extend("x", 1, 3);
    file.extend("s", 1, 2);
    file.extend("n", 1, 3);
    file.write_rows("x", 2, std::vector<double>{7.0, 8.0, 9.0});
  }
  const Hdf5File file = Hdf5File::open(path);
  EXPECT_EQ(file.shape("x"), (Shape{3, 3}));
  const std::vector<double> x = file.read_real("x");
  ASSERT_EQ(x.size(), 9U);
  for (const auto& [at, expected] : std::vector<std::pair<std::size_t, double>>{
           {0, 1.0}, {1, 2.0}, {3, 3.0}, {4, 4.0}, {6, 7.0}, {7, 8.0}, {8, 9.0}}) {
    EXPECT_EQ(x[at], expected) << at;
  }
  EXPECT_TRUE(std::isnan(x[2]) && std::isnan(x[5]));
  const std::vector<Complex> s = file.read_complex("s");
  ASSERT_EQ(s.size(), 2U);
  EXPECT_EQ(s[0], Complex(1.0, 2.0));
  EXPECT_TRUE(std::isnan(s[1].real()) && std::isnan(s[1].imag()));
  EXPECT_EQ(file.read_integers("n"), (std::vector<std::int64_t>{5, 6, -1}));
}

TEST_F(Hdf5FileTest, FlushedRowsAreInTheFileWhileItIsStillOpen) {
  Hdf5Writer file = Hdf5Writer::create(path);
  file.create_dataset(growing("p", ElementType::real, {0}));
  file.write_rows("p", 0, std::vector<double>{1, 2, 3});
  file.flush();
  const std::string copy = path_of("_copy.h5");
  std::filesystem::copy_file(path, copy, std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(Hdf5File::open(copy).read_real("p"), (std::vector<double>{1, 2, 3}));
  std::filesystem::remove(copy);
}

TEST_F(Hdf5FileTest, AttributesKeepTheirTypeAndTheirLastValue) {
  {
    Hdf5Writer file = Hdf5Writer::create(path);
    file.set_attribute("title", std::string("Träger"));
    file.set_attribute("empty", std::string());
    file.set_attribute("tolerance", 1e-8);
    file.set_attribute("count", std::int64_t{1} << 40);
    file.set_attribute("status", std::string("running"));
    file.set_attribute("status", std::string("completed"));
    file.create_dataset({"p", ElementType::real, {1}, false, {{"units", "rad/s"}}});
  }
  const Hdf5File file = Hdf5File::open(path);
  EXPECT_EQ(file.text_attribute("title"), "Träger");
  EXPECT_EQ(file.text_attribute("empty"), "");
  EXPECT_EQ(file.real_attribute("tolerance"), 1e-8);
  EXPECT_EQ(file.integer_attribute("count"), std::int64_t{1} << 40);
  EXPECT_EQ(file.text_attribute("status"), "completed");
  EXPECT_EQ(file.text_attribute("p", "units"), "rad/s");
  EXPECT_EQ(file.text_attribute("p", "unknown"), "");
  EXPECT_TRUE(file.has_attribute("title"));
  EXPECT_FALSE(file.has_attribute("units"));
  EXPECT_EQ(file.attribute_texts(), (std::map<std::string, std::string>{{"count", "1099511627776"},
                                                                        {"empty", ""},
                                                                        {"status", "completed"},
                                                                        {"title", "Träger"},
                                                                        {"tolerance", "1e-08"}}));
}

TEST_F(Hdf5FileTest, HasFollowsNestedPaths) {
  Hdf5Writer::create(path);
  with_hdf5(path, [](hid_t file) {
    H5Gclose(H5Gcreate2(file, "M", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    const hsize_t size = 1;
    const double value = 2.5;
    ASSERT_GE(H5LTmake_dataset_double(file, "M/0", 1, &size, &value), 0);
  });
  const Hdf5File file = Hdf5File::open(path);
  for (const std::string present : {"/M", "M", "/M/0", "M/0"}) EXPECT_TRUE(file.has(present)) << present;
  for (const std::string absent : {"/M/1", "/K/0", "K", "/M/0/0", "/M/0/0/0", "m/0", ""}) {
    EXPECT_FALSE(file.has(absent)) << absent;
  }
  EXPECT_EQ(file.read_real("/M/0"), std::vector<double>{2.5});
}

TEST_F(Hdf5FileTest, CreatingRefusesAnExistingFile) {
  Hdf5Writer::create(path).create_dataset(fixed("old", ElementType::real, {1}));
  EXPECT_TRUE(contains(error_text<Hdf5Error>([&] { Hdf5Writer::create(path); }), path));
  EXPECT_TRUE(Hdf5File::open(path).has("old"));
}

TEST_F(Hdf5FileTest, MembersAreListedByName) {
  Hdf5Writer file = Hdf5Writer::create(path);
  for (const char* name : {"b", "a", "c"}) file.create_dataset(fixed(name, ElementType::real, {1}));
  EXPECT_EQ(read_back(file).members("/"), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_TRUE(contains(error_text<Hdf5Error>([&] { (void)read_back(file).members("/none"); }), "none"));
}

/// One dataset and one attribute of every type.
Hdf5Writer file_of_all_types(const std::string& path) {
  Hdf5Writer file = Hdf5Writer::create(path);
  file.create_dataset(fixed("real", ElementType::real, {2, 3}));
  file.create_dataset(fixed("complex", ElementType::complex, {2}));
  file.create_dataset(fixed("text", ElementType::text, {2}));
  file.write_rows("real", 0, std::vector<double>(6, 1.0));
  file.write_rows("complex", 0, std::vector<Complex>(2));
  file.write_rows("text", 0, std::vector<std::string>{"a", "b"});
  file.set_attribute("real", 2.5);
  file.set_attribute("text", std::string("2.5"));
  return file;
}

TEST_F(Hdf5FileTest, ReadingAsAnotherTypeThrows) {
  Hdf5Writer written = file_of_all_types(path);
  const Hdf5File file = read_back(written);
  const std::vector<std::pair<std::string, std::function<void()>>> table = {
      {"real as complex", [&] { file.read_complex("real"); }},
      {"real as text", [&] { file.read_texts("real"); }},
      {"complex as real", [&] { file.read_real("complex"); }},
      {"complex as text", [&] { file.read_texts("complex"); }},
      {"text as real", [&] { file.read_real("text"); }},
      {"text as complex", [&] { file.read_complex("text"); }},
      {"missing dataset", [&] { file.read_real("missing"); }},
      {"shape of a missing dataset", [&] { file.shape("missing"); }},
      {"text attribute as real", [&] { file.real_attribute("text"); }},
      {"text attribute as integer", [&] { file.integer_attribute("text"); }},
      {"fraction as integer", [&] { file.integer_attribute("real"); }},
      {"real attribute as text", [&] { file.text_attribute("real"); }},
      {"missing attribute", [&] { file.text_attribute("missing"); }}};
  for (const auto& [what, action] : table) EXPECT_THROW(action(), Hdf5Error) << what;
}

TEST_F(Hdf5FileTest, AttributesThatAreArraysAreRefusedAsSingleValues) {
  // Reading them into one number would write past it.
  Hdf5Writer::create(path);
  with_hdf5(path, [](hid_t file) {
    const std::vector<double> values(64, 1.0);
    const std::vector<long long> counts(64, 1);
    ASSERT_GE(H5LTset_attribute_double(file, "/", "values", values.data(), values.size()), 0);
    ASSERT_GE(H5LTset_attribute_long_long(file, "/", "counts", counts.data(), counts.size()), 0);
  });
  const Hdf5File file = Hdf5File::open(path);
  EXPECT_THROW(file.real_attribute("values"), Hdf5Error);
  EXPECT_THROW(file.integer_attribute("counts"), Hdf5Error);
}

TEST_F(Hdf5FileTest, WritingWhatDoesNotFitThrows) {
  Hdf5Writer file = file_of_all_types(path);
  const std::vector<double> row(3, 2.0);
  const std::vector<std::pair<std::string, std::function<void()>>> table = {
      {"text into real", [&] { file.write_rows("real", 0, std::vector<std::string>(3)); }},
      {"real into complex", [&] { file.write_rows("complex", 0, row); }},
      {"real into text", [&] { file.write_rows("text", 0, std::vector<double>(1)); }},
      {"half a row", [&] { file.write_rows("real", 0, std::vector<double>(4)); }},
      {"beyond the end of a dataset that does not grow", [&] { file.write_rows("real", 2, row); }},
      {"missing dataset", [&] { file.write_rows("missing", 0, row); }},
      {"name taken", [&] { file.create_dataset(fixed("real", ElementType::real, {1})); }},
      {"scale that is missing", [&] { file.attach_scale("real", "missing", 0); }}};
  for (const auto& [what, action] : table) EXPECT_THROW(action(), Hdf5Error) << what;
  EXPECT_EQ(read_back(file).read_real("real"), std::vector<double>(6, 1.0)) << "and leaves the data alone";
}

TEST_F(Hdf5FileTest, WritingDataIntoRowsWithoutColumnsThrows) {
  Hdf5Writer file = Hdf5Writer::create(path);
  file.create_dataset(growing("none", ElementType::real, {0, 0}));
  EXPECT_THROW(file.write_rows("none", 0, std::vector<double>(3)), Hdf5Error);
}

TEST_F(Hdf5FileTest, DatasetsTooLargeForMemoryAreRefused) {
  Hdf5Writer file = Hdf5Writer::create(path);
  file.create_dataset(growing("huge", ElementType::real, {0, std::uint64_t{1} << 20}));
  with_hdf5(path, [](hid_t handle) {
    const hid_t set = H5Dopen2(handle, "huge", H5P_DEFAULT);
    const std::array<hsize_t, 2> size = {std::uint64_t{1} << 44, std::uint64_t{1} << 20};
    EXPECT_GE(H5Dset_extent(set, size.data()), 0);
    H5Dclose(set);
  });
  EXPECT_TRUE(contains(error_text<Hdf5Error>([&] { read_back(file).read_real("huge"); }), "too large"));
}

TEST(ElementCount, IsTheProductOfTheDimensionsWithoutOverflow) {
  EXPECT_EQ(element_count({}), 1U);
  EXPECT_EQ(element_count({3, 4, 5}), 60U);
  EXPECT_EQ(element_count({3, 0, 5}), 0U);
  EXPECT_GT(element_count({std::uint64_t{1} << 33U, std::uint64_t{1} << 33U}), std::uint64_t{1} << 31U)
      << "2^66 modulo 2^64 is 4";
}

}  // namespace
}  // namespace eigentrail::test::hdf5_file_test
