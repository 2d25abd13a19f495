// Forces between bodies from the case to the file, the page and the exports.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gem/base/number_text.h"
#include "gem/command/command_fixture.h"
#include "gem/record/run_file/contact_record.h"
#include "gem/record/run_file/run_file.h"

namespace gem {
namespace {

class ContactForcesCommandTest : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    std::ofstream(path("jam.toml")) << "include = [\"" GEM_SOURCE_DIR
                                       "/cases/first.toml\"]\n[run]\nduration_s = 60.0\n";
  }

  /// A jam of 60 floes, with a sample of the platform in every time step.
  static std::string jam(const std::string& more) {
    return "gem run jam.toml --threads 1 -q --set floes.count=60 --set floes.length_m=100.0 "
           "--set floes.width_m=60.0 --set floes.start_x_m=-135.0 --set 'current.velocity_m_per_s=[1.0, 0.0]' "
           "--set numerics.time_step_s=0.05 --set output.platform_interval_s=0.05 --set output.floes_interval_s=2.0 " +
           more;
  }
};

TEST_F(ContactForcesCommandTest, AreThoseThatThePlatformFeelsAndChangeNoRun) {
  ASSERT_EQ(shell(jam("--out plain.h5") + " && " + jam("--out forces.h5 --set output.contact_forces=true")), 0)
      << text_of("err");
  EXPECT_FALSE(RunFile(path("plain.h5")).has("contacts/time"));
  EXPECT_EQ(RunFile(path("plain.h5")).attribute("gem_case_toml").find("contact_forces"), std::string::npos)
      << "cases without the key keep their hash";
  const RunFile run(path("forces.h5"));
  EXPECT_EQ(run.attribute("gem_state_hash"), RunFile(path("plain.h5")).attribute("gem_state_hash"));
  const ContactRecord record(run);
  const std::vector<double> frames = run.column("floes/time"), times = run.column("platform/time");
  const std::vector<double> fx = run.column("platform/ice_force_x"), fy = run.column("platform/ice_force_y");
  std::size_t loaded = 0;
  for (const double time : frames) {
    Vec2 sum;
    double largest = 1.0;
    for (const ContactForce& c : record.at(time)) {
      if (c.a == 0) sum -= c.force;
      largest = std::max(largest, length(c.force));
    }
    const auto at = static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), time - 1e-6) - times.begin());
    EXPECT_LE(length(sum - Vec2{fx[at], fy[at]}), 1e-5 * largest) << "frame at " << time << " s";
    loaded += length(sum) > 0.0;
  }
  EXPECT_GT(loaded, 3U);
  EXPECT_TRUE(record.at(0.0).empty());
}

TEST_F(ContactForcesCommandTest, ARunThatGoesOnHasTheRowsOfOneThatNeverStopped) {
  ASSERT_EQ(shell(jam("--out whole.h5 --set output.contact_forces=true") + " && " +
                  jam("--out parts.h5 --set output.contact_forces=true --until 31") +
                  " && gem run --continue parts.h5 -q --threads 1"),
            0)
      << text_of("err");
  const RunFile whole(path("whole.h5")), parts(path("parts.h5"));
  ASSERT_GT(whole.rows("contacts/time"), 100U);
  for (const char* name : {"time", "body_a", "body_b", "x", "y", "force_x", "force_y"})
    EXPECT_EQ(whole.column(std::string("contacts/") + name), parts.column(std::string("contacts/") + name)) << name;
}

TEST_F(ContactForcesCommandTest, AreExported) {
  ASSERT_EQ(shell(jam("--out forces.h5 --set output.contact_forces=true") +
                  " && gem export forces.h5 film.pvd && gem export forces.h5 forces.csv --table contacts"),
            0)
      << text_of("err");
  EXPECT_NE(text_of("film.pvd").find("name=\"contacts\""), std::string::npos);
  EXPECT_TRUE(exists("film_vtp/contacts_000030.vtp"));
  const std::string table = text_of("forces.csv");
  EXPECT_EQ(table.substr(0, table.find('\n')), "time_s,floe_a,floe_b,x_m,y_m,force_x_N,force_y_N");
  EXPECT_NE(table.find(",-1,"), std::string::npos) << "the platform is -1";
  ASSERT_EQ(shell(jam("--out plain.h5")), 0);
  EXPECT_EQ(shell("gem export plain.h5 none.csv --table contacts"), 2);
  EXPECT_NE(text_of("err").find("did not record them"), std::string::npos) << text_of("err");
}

}  // namespace
}  // namespace gem
