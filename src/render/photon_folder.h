#pragma once
// The photons of a job's map, sent and relaxed by all of its workers together, without anything that tells them what to do. What is done is a
// file in the job's folder (photon_file.h):
//
//   photons/range_03_of_39.photons      range 3 (src/integrator/photon_sending.h), sent
//   photons/relaxed_0_of_1.photons      caustics of pass 0, relaxed
//
// A worker makes what is missing. It begins at a place of its own and looks again before each file, so that it goes on where others have not
// been. The temporary file of what is being made shows that another is at it: that comes last, and is waited for where the other is on this
// machine and runs. Two workers on one file do no harm. Then each gathers all in order: the photons of one process, to the bit.

#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "phase/base/whole_file.h"
#include "src/integrator/photon_passes.h"
#include "src/render/photon_file.h"
#include "src/render/tile_job.h"

namespace arcus::render {

std::string photon_range_path(const std::string& job_folder, std::size_t ranges, std::size_t range);
std::string relaxed_photons_path(const std::string& job_folder, std::size_t passes, std::size_t pass);

/// What photons a job's folder holds.
struct PhotonSurvey {
  std::size_t ranges = 0, ranges_done = 0;   ///< in all, 0 where nothing is there that says it; whole and of this job
  std::size_t passes = 0, passes_done = 0;   ///< to be relaxed; relaxed
  std::vector<std::string> foreign;          ///< files of another job
  std::string foreign_because;               ///< of the first: a sentence that begins with the file
};

/// is_thorough: reads the photons as well; otherwise headers vouch for them.
PhotonSurvey survey_photons(const std::string& job_folder, const TileJob& job, bool is_thorough);

class PhotonFolder : public PhotonSource {
 public:
  /// `say` is told of what is made and of files that are damaged. Throws cannot() where the folder cannot be made.
  PhotonFolder(const std::string& job_folder, const TileJob& job, const PhotonSending& sending, const std::atomic<int>* stop_request,
               std::function<void(std::string_view)> say);

  /// Makes what is missing, beginning at `start` of the whole, 0 to 1; false where stop_request became non-zero before all was there: what is
  /// made stays. Throws Fault::mismatch where a file is of another job, cannot() where one cannot be written.
  bool share(double start);

  // What is there is read and verified, what is damaged or gone made anew.
  std::optional<std::vector<LandedPhotons>> landed(std::size_t range) override;
  std::optional<Relaxed> relax(std::uint32_t pass, std::vector<Photon>& photons) override;
  /// All caustics of a pass on surfaces, as they landed.
  std::optional<std::vector<Photon>> caustics_of(std::size_t pass);

 private:
  /// Files of one sort.
  struct Shelf {
    const char* word;
    std::size_t count;
    std::vector<bool> is_there;  ///< have been seen to be whole, and are not looked at again
  };
  std::string path_of(const Shelf& shelf, std::size_t number) const;
  /// What such a file holds.
  std::vector<PhotonStretch> stretches_of(const Shelf& shelf, std::size_t number) const;
  struct Missing {
    std::size_t number;
    bool is_being_made;
  };
  /// The first from there on that is missing, of those that nobody is at if there are such.
  std::optional<Missing> missing(Shelf& shelf, double start) const;
  /// Waits a moment where another process of this machine is at it; false where none is, or all has taken too long.
  bool wait_for(const Shelf& shelf, const Missing& one);
  std::optional<StoredPhotons> read(const Shelf& shelf, std::size_t number) const;
  void write(Shelf& shelf, std::size_t number, WholeFile& file, StoredPhotons& stored);
  std::optional<std::vector<LandedPhotons>> send(std::size_t range);
  std::optional<Relaxed> relax_here(std::size_t pass, std::vector<Photon>& photons, WholeFile& file);
  void say_done(const std::string& what, std::chrono::steady_clock::time_point begin) const;
  bool is_stopped() const { return stop_request_ && stop_request_->load() != 0; }

  std::string job_folder_;
  const TileJob& job_;
  const PhotonSending& sending_;
  const std::atomic<int>* stop_request_;
  std::function<void(std::string_view)> say_;
  Shelf ranges_, relaxed_;
  double waited_s_ = 0;
};

}  // namespace arcus::render
