#pragma once
/// What the detection learns of the plants of a campaign, each commissioned once a process, in
/// files of a folder that lives as long as this object.
#include <memory>
#include <mutex>

#include "campaign/campaign_file.h"

namespace ambrig {

class CommissionedPlants {
 public:
  /// `campaign` must outlive it.
  explicit CommissionedPlants(const Campaign& campaign);
  ~CommissionedPlants();
  CommissionedPlants(const CommissionedPlants&) = delete;
  CommissionedPlants& operator=(const CommissionedPlants&) = delete;

  /// Commissioning file of plant k. Empty where the machine cannot be commissioned (it touches in
  /// its commissioning run): it then runs as one that was not. Thread-safe.
  std::string FileOf(std::size_t plant);

 private:
  struct Entry {
    std::once_flag once;
    std::string file;
  };
  std::string Commissioned(std::size_t plant) const;

  const Campaign& campaign_;
  std::string folder_;
  std::vector<std::unique_ptr<Entry>> entries_;
};

}  // namespace ambrig
