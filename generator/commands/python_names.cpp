#include "commands/python_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace jourdain::commands {

namespace {

// Python 3.11.
constexpr std::array<std::string_view, 35> kWords = {
    "False", "None",     "True",  "and",    "as",   "assert", "async",  "await",    "break",
    "class", "continue", "def",   "del",    "elif", "else",   "except", "finally",  "for",
    "from",  "global",   "if",    "import", "in",   "is",     "lambda", "nonlocal", "not",
    "or",    "pass",     "raise", "return", "try",  "while",  "with",   "yield"};

/// Its library's modules, and those of numerics that they would be imported beside.
constexpr std::string_view kModules =
    " abc aifc antigravity argparse array ast asynchat asyncio asyncore atexit audioop base64 bdb binascii "
    "bisect "
    "builtins bz2 cProfile calendar cgi cgitb chunk cmath cmd code codecs codeop collections colorsys "
    "compileall "
    "concurrent configparser contextlib contextvars copy copyreg crypt csv ctypes curses dataclasses "
    "datetime dbm "
    "decimal difflib dis distutils doctest email encodings ensurepip enum errno faulthandler fcntl filecmp "
    "fileinput "
    "fnmatch fractions ftplib functools gc genericpath getopt getpass gettext glob graphlib grp gzip hashlib "
    "heapq "
    "hmac html http idlelib imaplib imghdr imp importlib inspect io ipaddress itertools json keyword lib2to3 "
    "linecache "
    "locale logging lzma mailbox mailcap marshal math mimetypes mmap modulefinder msilib multiprocessing "
    "netrc nis "
    "nntplib nt ntpath nturl2path numbers opcode operator optparse os ossaudiodev pathlib pdb pickle "
    "pickletools pipes "
    "pkgutil platform plistlib poplib posix posixpath pprint profile pstats pty pwd py_compile pyclbr pydoc "
    "pydoc_data "
    "pyexpat queue quopri random re readline reprlib resource rlcompleter runpy sched secrets select "
    "selectors shelve "
    "shlex shutil signal site smtpd smtplib sndhdr socket socketserver spwd sqlite3 sre_compile "
    "sre_constants "
    "sre_parse ssl stat statistics string stringprep struct subprocess sunau symtable sys sysconfig syslog "
    "tabnanny "
    "tarfile telnetlib tempfile termios test textwrap this threading time timeit tkinter token tokenize "
    "tomllib trace "
    "traceback tracemalloc tty turtle turtledemo types typing unicodedata unittest urllib uu uuid venv "
    "warnings wave "
    "weakref webbrowser winreg winsound wsgiref xdrlib xml xmlrpc zipapp zipfile zipimport zlib zoneinfo "
    "matplotlib "
    "numpy scipy ";

}  // namespace

bool is_python_word(const std::string& name) {
  return std::find(kWords.begin(), kWords.end(), name) != kWords.end();
}

std::string wrong_module_name(const std::string& name) {
  if (is_python_word(name))
    return fmt::format("'{}' is a word of Python and no name of a module; choose another with --name", name);
  if (kModules.find(" " + name + " ") != std::string_view::npos)
    return fmt::format(
        "a module '{0}' would hide Python's own module of this name; choose another with --name", name);
  return "";
}

}  // namespace jourdain::commands
