// HDF5's C library with owned handles and checked calls. Used by floe's event files and sky maps.
//
// HDF5 is not thread safe: one thread at a time may read or write event files.
#pragma once

#include <hdf5.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace floe {

// A call of the library that failed; the reader and the writer turn it into InputError / OutputError.
struct Hdf5Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Keeps HDF5 from printing its own errors while it lives. Made before any other call of the library.
class Hdf5Silence {
 public:
  Hdf5Silence() {
    // After some damaged files the library's own tidying up at exit fails, and says so on the terminal.
    // It is not needed: every handle here has an owner.
    [[maybe_unused]] static const herr_t no_tidying = H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Hdf5Silence() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Hdf5Silence(const Hdf5Silence&) = delete;
  Hdf5Silence& operator=(const Hdf5Silence&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

// The innermost reason of the call that failed last, e.g. "truncated file: eof = ...".
inline std::string hdf5_reason() {
  std::string reason;
  const auto keep_first = [](unsigned n, const H5E_error2_t* error, void* out) -> herr_t {
    if (n == 0 && error->desc) *static_cast<std::string*>(out) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
  return reason;
}

// The result of a call whose results below 0 mean failure.
template <typename Result>
Result checked(Result result, const char* doing) {
  if (result < 0) throw Hdf5Failure(std::string(doing) + ": " + hdf5_reason());
  return result;
}

// Owns one identifier of the library.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Close closer, const char* doing) : id_(checked(id, doing)), close_(closer) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, none)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }

  operator hid_t() const { return id_; }
  bool open() const { return id_ >= 0; }
  void close(const char* doing) {
    if (id_ >= 0) checked(close_(std::exchange(id_, none)), doing);
  }

 private:
  static constexpr hid_t none = -1;
  hid_t id_ = none;
  Close close_ = nullptr;
};

}  // namespace floe
