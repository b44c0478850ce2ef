//! Scenario files from outside: what they may say, what is drawn from them, what is rejected.

mod catalog;
mod drawing;
mod mistakes;
mod placing;
mod road;
mod validity;
