/* SPDX-License-Identifier: Apache-2.0
 * Records the objects that a test owns. The test's teardown frees these objects, even after a failed assertion. Each thread has
 * its own list. A thread that the test starts frees its objects with free_owned_after. Include after riis.h and test_support.h;
 * handles.h includes it. */
#ifndef RIIS_TEST_OWNED_H
#define RIIS_TEST_OWNED_H

typedef struct owned_object {
  void *object;
  void (*destroy)(void *object);
} owned_object;

enum { most_owned = 1000 };
static _Thread_local struct owned_objects {
  owned_object at[most_owned];
  int n, n_of_group;
} owned;

static inline void own_object(void *object, void (*destroy)(void *)) {
  for (int i = 0; i < owned.n; ++i)
    if (owned.at[i].object == object) fail_msg("a test owns an object twice");
  if (owned.n == most_owned) {
    destroy(object);
    fail_msg("a test owns more than %d objects", most_owned);
  }
  owned.at[owned.n++] = (owned_object){object, destroy};
}

static inline int n_owned(void) { return owned.n; }

/* Frees all objects except the first n, in reverse order. */
static inline void free_owned_after(int n) {
  while (owned.n > n) {
    const owned_object last = owned.at[--owned.n];
    last.destroy(last.object);
  }
}

/* Takes an object off the list and returns the entry. The entry's `destroy` is NULL if the object was not on the list. */
static inline owned_object disown(void *object) {
  int i = owned.n - 1;
  while (i >= 0 && owned.at[i].object != object) --i;
  if (i < 0) return (owned_object){object, NULL};
  const owned_object found = owned.at[i];
  --owned.n;
  memmove(owned.at + i, owned.at + i + 1, (size_t)(owned.n - i) * sizeof *owned.at);
  return found;
}

/* Frees one object before its test ends. NULL is allowed. */
static inline void free_one_owned(void *object) {
  if (!object) return;
  const owned_object found = disown(object);
  if (!found.destroy) fail_msg("the object is not owned");
  found.destroy(object);
}

/* The teardown of a test. */
static inline int free_owned(void **state) {
  (void)state;
  free_owned_after(owned.n_of_group);
  return 0;
}

/* Call this function at the end of a group's setup. All objects made before then last until the group's teardown,
 * free_owned_of_group. */
static inline void keep_owned_for_group(void) { owned.n_of_group = owned.n; }

static inline int free_owned_of_group(void **state) {
  owned.n_of_group = 0;
  return free_owned(state);
}

static inline void *own_memory(void *memory) {
  if (memory) own_object(memory, free);
  return memory;
}

#define DEFINE_OWN(type)                                               \
  static inline void destroy_owned_##type(void *object) {              \
    riis_##type *handle = object;                                      \
    riis_##type##_destroy(&handle);                                    \
  }                                                                    \
  static inline riis_##type *own_##type(riis_##type *handle) {         \
    if (handle) own_object(handle, destroy_owned_##type);              \
    return handle;                                                     \
  }                                                                    \
  static inline void destroy_and_disown_##type(riis_##type **handle) { \
    void *const object = handle ? *handle : NULL;                      \
    riis_##type##_destroy(handle);                                     \
    if (object && !*handle) disown(object);                            \
  }
DEFINE_OWN(valve)
DEFINE_OWN(surface)
DEFINE_OWN(mesh)
DEFINE_OWN(adjacency)
DEFINE_OWN(marks)
DEFINE_OWN(leaks)
DEFINE_OWN(crossings)
DEFINE_OWN(keyframes)
DEFINE_OWN(warp)
#undef DEFINE_OWN

/* A test may itself destroy an object that it owns. */
#define riis_valve_destroy destroy_and_disown_valve
#define riis_surface_destroy destroy_and_disown_surface
#define riis_mesh_destroy destroy_and_disown_mesh
#define riis_adjacency_destroy destroy_and_disown_adjacency
#define riis_marks_destroy destroy_and_disown_marks
#define riis_leaks_destroy destroy_and_disown_leaks
#define riis_crossings_destroy destroy_and_disown_crossings
#define riis_keyframes_destroy destroy_and_disown_keyframes
#define riis_warp_destroy destroy_and_disown_warp

/* Records a handle or memory from malloc, and returns it. */
#define own(object) \
  _Generic((object),                       \
      riis_valve *: own_valve,             \
      riis_surface *: own_surface,         \
      riis_mesh *: own_mesh,               \
      riis_adjacency *: own_adjacency,     \
      riis_marks *: own_marks,             \
      riis_leaks *: own_leaks,             \
      riis_crossings *: own_crossings,     \
      riis_keyframes *: own_keyframes,     \
      riis_warp *: own_warp,               \
      void *: own_memory)(object)

/* In a file that includes this header, every test has the teardown. */
#undef TEST
#define TEST(name) TEST_WITH(name, NULL, free_owned)

#endif
