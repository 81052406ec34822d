#!/usr/bin/env bash
# summarise_tests.sh FOLDER: prints "N passed, N failed[, N skipped]" and fails when a test failed.
# FOLDER holds ctest.junit, the list of programs that ctest ran, and for each GoogleTest program
# NAME.xml with its cases. A program without such a report (it crashed, or is no GoogleTest) is one test.
set -euo pipefail
folder=$1
passed=0 failed=0 skipped=0

attribute() { # NAME LINE
  sed -n "s/.*[[:space:]]$1=\"\([^\"]*\)\".*/\1/p" <<<"$2"
}

while IFS= read -r line; do
  name=$(attribute name "$line")
  status=$(attribute status "$line")
  report="$folder/$name.xml"
  if [ -s "$report" ]; then
    suites=$(grep -m 1 '<testsuites ' "$report")
    tests=$(attribute tests "$suites")
    bad=$(($(attribute failures "$suites") + $(attribute errors "$suites")))
    left_out=$(grep -c 'result="skipped"' "$report" || true)
    # A program can also fail after its last case (a leak, a crash at exit, too much time).
    if [ "$status" = fail ] && [ "$bad" -eq 0 ]; then
      bad=1
      tests=$((tests + 1))
    fi
    failed=$((failed + bad)) skipped=$((skipped + left_out)) passed=$((passed + tests - bad - left_out))
  else
    case "$status" in
      run) passed=$((passed + 1)) ;;
      fail) failed=$((failed + 1)) ;;
      *) skipped=$((skipped + 1)) ;;
    esac
  fi
done < <(grep '<testcase ' "$folder/ctest.junit")

summary="$passed passed, $failed failed"
if [ "$skipped" -gt 0 ]; then summary+=", $skipped skipped"; fi
echo "$summary"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
