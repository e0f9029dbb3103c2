#pragma once
// What the headers of LAMMPS name of the fmt that it bundles, where a package leaves those headers out (liblammps-dev of
// Debian 12). Declarations alone: calls that format through it do not link, and the styles make none.

namespace fmt {

class string_view;
class format_args;

template <class... Args, class Format>
format_args make_args_checked(const Format& format, const Args&... args);

}  // namespace fmt
