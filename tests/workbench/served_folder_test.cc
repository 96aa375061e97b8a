// Nothing outside the folder, nothing hidden, nothing that is no file: by whatever name it is asked
// for.
#include "workbench/served_folder.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "core/base/errors.h"
#include "tests/workbench/bench_folder.h"

namespace ambrig::workbench {
namespace {

class Served : public BenchFolder {};

TEST_F(Served, ReadsWhatIsItsOwn) {
  const ServedFolder folder(served());
  EXPECT_EQ(folder.Read("a.toml", 100), "x = 1\n");
  EXPECT_EQ(folder.Read("sub/b.csv", 100), "t,x\n0,1\n1,2\n");
  EXPECT_THROW(folder.Read("a.toml", 3), InputError);
  EXPECT_THROW(folder.Read("missing.toml", 3), InputError);
}

TEST_F(Served, RefusesNamesThatLeaveIt) {
  const ServedFolder folder(served());
  for (const std::string& name :
       {std::string("../other/secret.toml"), (base_ / "other/secret.toml").string(),
        std::string("sub/../../other/secret.toml"), std::string("sub/..//a.toml"),
        std::string(".ambrig/x.toml"), std::string("sub/.hidden.toml"), std::string(""),
        std::string("/"), std::string("sub"), std::string("a"), std::string("-o.toml"),
        std::string("a.toml\n"), std::string("a.exe"), std::string("a\0b.toml", 8),
        std::string("..\\other\\secret.toml"), std::string(2000, 'a') + ".toml",
        std::string("/proc/self/environ")})
    EXPECT_THROW(folder.Read(name, 1000), InputError) << name;
}

TEST_F(Served, FollowsNoLink) {
  std::filesystem::create_symlink(base_ / "other" / "secret.toml", base_ / "served" / "link.toml");
  std::filesystem::create_directory_symlink(base_ / "other", base_ / "served" / "door");
  std::filesystem::create_symlink("a.toml", base_ / "served" / "inside.toml");
  const ServedFolder folder(served());
  for (const char* name : {"link.toml", "door/secret.toml", "inside.toml"})
    EXPECT_THROW(folder.Read(name, 1000), InputError) << name;
  EXPECT_THROW(folder.Write("door/new.toml", "x"), InputError);
  EXPECT_FALSE(std::filesystem::exists(base_ / "other" / "new.toml"));
  std::vector<std::string> names;
  for (const ServedFile& f : folder.List(100)) names.push_back(f.name);
  EXPECT_THAT(names, ::testing::ElementsAre("a.toml", "sub/b.csv"));
}

// A FIFO would hang whoever opens it.
TEST_F(Served, OpensRegularFilesOnly) {
  ASSERT_EQ(::mkfifo((base_ / "served" / "pipe.toml").c_str(), 0600), 0);
  std::filesystem::create_directories(base_ / "served" / "folder.toml");
  const ServedFolder folder(served());
  EXPECT_THROW(folder.Read("pipe.toml", 10), InputError);
  EXPECT_THROW(folder.Read("folder.toml", 10), InputError);
  EXPECT_FALSE(folder.Has("pipe.toml"));
}

TEST_F(Served, WritesWholeFiles) {
  const ServedFolder folder(served());
  folder.Write("sub/new.toml", "y = 2\n");
  EXPECT_EQ(Text("served/sub/new.toml"), "y = 2\n");
  folder.Write("a.toml", std::string(1 << 20, 'z'));
  EXPECT_EQ(Text("served/a.toml").size(), 1u << 20);
  EXPECT_THROW(folder.Write("missing/new.toml", "y"), InputError);
  std::size_t files = 0;  // no temporary one is left
  for (const auto& e : std::filesystem::recursive_directory_iterator(served()))
    files += e.is_regular_file();
  EXPECT_EQ(files, 3u);
}

TEST_F(Served, AnUploadReplacesNothing) {
  const ServedFolder folder(served());
  Write("upload", "new");
  EXPECT_THROW(folder.MoveIn((base_ / "upload").string(), "a.toml"), InputError);
  EXPECT_EQ(Text("served/a.toml"), "x = 1\n");
  folder.MoveIn((base_ / "upload").string(), "sub/log.csv");
  EXPECT_EQ(Text("served/sub/log.csv"), "new");
}

}  // namespace
}  // namespace ambrig::workbench
