//! Fixtures of ad-rss-lib and worked numbers.
