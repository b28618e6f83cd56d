#ifndef nmm_base_archive_h
#define nmm_base_archive_h

#include <nmm/base/exceptions.h>

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace NMM
{
  // Values as bytes, for checkpoints. A file may be damaged or forged, so a reader trusts no number
  // of it: neither the length of a list nor, in what reads it, an index.

  /// @throws InputError "The checkpoint is damaged: ..." with @p what, unless @p is_right.
  inline void
  require_in_checkpoint(const bool is_right, const std::string &what)
  {
    AssertThrow(is_right,
                InputError("The checkpoint is damaged: " + what,
                           "",
                           "take another one, or start anew"));
  }


  /// Whether none of the numbers is infinite or not a number.
  template <typename Numbers>
  bool
  are_finite(const Numbers &numbers)
  {
    return std::all_of(std::begin(numbers),
                       std::end(numbers),
                       [](const double x) { return std::isfinite(x); });
  }


  /**
   * Appends values to a sequence of bytes. Numbers, strings, vectors, arrays, pairs, points and
   * vectors of space can be written, and classes by their function serialize(), either a member or one
   * beside the class, which is the same for writing and reading:
   * @code
   * template <class Archive>
   * void
   * serialize(Archive &archive, unsigned int)
   * {
   *   archive &plastic_extension &is_broken;
   * }
   * @endcode
   */
  class ByteWriter
  {
  public:
    static constexpr bool is_reading = false;

    template <typename T>
    ByteWriter &
    operator&(const T &value);

    void
    transfer(void *bytes, const std::size_t n)
    {
      const char *begin = static_cast<const char *>(bytes);
      written.insert(written.end(), begin, begin + n);
    }

    /// Writes the length of a list.
    template <typename List>
    void
    transfer_size(List &list)
    {
      std::uint64_t size = list.size();
      transfer(&size, sizeof(size));
    }

    std::vector<char> written;
  };


  /// Reads what a ByteWriter has written. @throws InputError if there are fewer bytes than that.
  class ByteReader
  {
  public:
    static constexpr bool is_reading = true;

    explicit ByteReader(const std::vector<char> &bytes)
      : next(bytes.data())
      , end(bytes.data() + bytes.size())
    {
    }

    template <typename T>
    ByteReader &
    operator&(T &value);

    void
    transfer(void *bytes, const std::size_t n)
    {
      require(n <= n_left());
      if (n > 0)
        std::memcpy(bytes, next, n);
      next += n;
    }

    /// Resizes a list to the length that is read. Each element has one byte at least, so that a
    /// wrong length cannot ask for more memory than the file has in proportion.
    template <typename List>
    void
    transfer_size(List &list)
    {
      std::uint64_t size;
      transfer(&size, sizeof(size));
      require(size <= n_left());
      list.resize(size);
    }

    std::size_t
    n_left() const
    {
      return end - next;
    }

    /// @throws InputError unless @p is_right.
    static void
    require(const bool is_right)
    {
      require_in_checkpoint(is_right,
                            "it is shorter or longer than it says itself");
    }

  private:
    const char *next;
    const char *end;
  };


  template <typename Archive, typename T, typename = void>
  struct HasMemberSerialize : std::false_type
  {
  };
  template <typename Archive, typename T>
  struct HasMemberSerialize<
    Archive,
    T,
    std::void_t<
      decltype(std::declval<T &>().serialize(std::declval<Archive &>(), 0u))>>
    : std::true_type
  {
  };


  /// Writes or reads a number, or a class by its function serialize().
  template <typename Archive, typename T>
  void
  transfer_value(Archive &archive, T &value)
  {
    if constexpr (std::is_same_v<T, bool>)
    {
      unsigned char byte = value ? 1 : 0;
      archive.transfer(&byte, 1);
      // Another byte than 0 and 1 is no value of this type.
      if constexpr (Archive::is_reading)
        Archive::require(byte <= 1);
      value = byte == 1;
    }
    else if constexpr (std::is_arithmetic_v<T>)
      archive.transfer(&value, sizeof(T));
    else if constexpr (HasMemberSerialize<Archive, T>::value)
      value.serialize(archive, 0u);
    else
      serialize(archive, value, 0u);
  }


  template <typename Archive, int dim>
  void
  transfer_value(Archive &archive, dealii::Tensor<1, dim> &tensor)
  {
    for (unsigned int d = 0; d < dim; ++d)
      archive &tensor[d];
  }


  template <typename Archive, int dim>
  void
  transfer_value(Archive &archive, dealii::Point<dim> &point)
  {
    for (unsigned int d = 0; d < dim; ++d)
      archive &point[d];
  }


  template <typename Archive>
  void
  transfer_value(Archive &archive, std::string &text)
  {
    archive.transfer_size(text);
    archive.transfer(text.data(), text.size());
  }


  template <typename Archive, typename First, typename Second>
  void
  transfer_value(Archive &archive, std::pair<First, Second> &pair)
  {
    archive &pair.first &pair.second;
  }


  template <typename Archive, typename T, std::size_t n>
  void
  transfer_value(Archive &archive, std::array<T, n> &array)
  {
    for (T &element : array)
      archive &element;
  }


  template <typename Archive, typename T>
  void
  transfer_value(Archive &archive, std::vector<T> &list)
  {
    archive.transfer_size(list);
    if constexpr (std::is_arithmetic_v<T>)
      archive.transfer(list.data(), list.size() * sizeof(T));
    else
      for (T &element : list)
        archive &element;
  }


  template <typename T>
  ByteWriter &
  ByteWriter::operator&(const T &value)
  {
    // The functions that write do not change the value; those that read are the same ones.
    transfer_value(*this, const_cast<T &>(value));
    return *this;
  }


  template <typename T>
  ByteReader &
  ByteReader::operator&(T &value)
  {
    transfer_value(*this, value);
    return *this;
  }


  /// The bytes of values, one after the other.
  template <typename... T>
  std::vector<char>
  to_bytes(const T &...values)
  {
    ByteWriter writer;
    (writer & ... & values);
    return std::move(writer.written);
  }


  /// Reads values from all bytes that to_bytes() has made of them. @throws InputError if there are
  /// more or fewer bytes.
  template <typename... T>
  void
  from_bytes(const std::vector<char> &bytes, T &...values)
  {
    ByteReader reader(bytes);
    (reader & ... & values);
    ByteReader::require(reader.n_left() == 0);
  }
} // namespace NMM

#endif
