#pragma once
/// One child process whose descriptor 3 is read line by line.
#include <functional>
#include <string>
#include <vector>

namespace ambrig::workbench {

struct ChildEnd {
  int code = -1;  // exit code; 128 + signal when one ended it
};

/// Starts `program` with `arguments` in the folder of descriptor `folder`; both outputs go to
/// `log`. `started` gets its process id; every line of its descriptor 3 goes to `line`; waits for
/// its end.
/// @throws InputError when it cannot be started
ChildEnd RunChild(const std::string& program, const std::vector<std::string>& arguments,
                  const std::string& folder, const std::string& log, int nice,
                  const std::function<void(int)>& started,
                  const std::function<void(const std::string&)>& line);

}  // namespace ambrig::workbench
