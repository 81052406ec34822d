// Where the time of a piece of work goes, by sampling: a timer interrupts it about a thousand times a second,
// and each time the function that is being executed gets a point. Nothing is added to the engine, so what is
// measured is the engine as it runs. The standard error of a share p is sqrt(p (1 - p)/samples).
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace floe {

struct ProfilePart {
  std::string name;
  double share = 0;  // of the samples
};

struct Profile {
  std::size_t samples = 0;
  std::vector<ProfilePart> parts;      // in the order of a photon's step; all shares add up to 1
  std::vector<ProfilePart> functions;  // the same by single functions or libraries, largest share first
};

// Runs the work, which must stay in one thread. One profile at a time in a process.
Profile profile_of(const std::function<void()>& work);

}  // namespace floe
