# For `ctest -M Nightly -T Start -T Test`, or `ctest -D Nightly` where a dashboard is named by CTEST_SUBMIT_URL.
set(CTEST_PROJECT_NAME "ddem")
set(CTEST_NIGHTLY_START_TIME "01:00:00 UTC")
