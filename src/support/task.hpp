// A computation that can pause in the middle, for results that are computed in batches for many tasks at once.
//
// A function that returns Task<T> and contains co_await or co_return begins when it is awaited by another task,
// or by start(). The innermost object that it awaits decides when it resumes. A task must not outlive what it
// refers to. Exceptions are rethrown where the result is taken.
#pragma once

#include <coroutine>
#include <exception>
#include <optional>
#include <utility>

#include "support/reused_memory.hpp"

namespace peterka {

template <class T>
class [[nodiscard]] Task {
  public:
    struct promise_type;
    using Handle = std::coroutine_handle<promise_type>;

    struct promise_type : Reused {
        std::optional<T> value;
        std::exception_ptr failure;
        std::coroutine_handle<> awaited_by = std::noop_coroutine();

        // On completion a task resumes the one that awaits it.
        struct End {
            [[nodiscard]] bool await_ready() const noexcept { return false; }
            [[nodiscard]] std::coroutine_handle<> await_suspend(Handle ended) const noexcept {
                return ended.promise().awaited_by;
            }
            void await_resume() const noexcept {}
        };

        Task get_return_object() { return Task(Handle::from_promise(*this)); }
        std::suspend_always initial_suspend() noexcept { return {}; }
        End final_suspend() noexcept { return {}; }
        void return_value(T result) { value.emplace(std::move(result)); }
        void unhandled_exception() { failure = std::current_exception(); }
    };

    Task(Task&& other) noexcept : handle_(std::exchange(other.handle_, {})) {}
    Task& operator=(Task&& other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }
    Task(const Task&) = delete;
    Task& operator=(const Task&) = delete;
    ~Task() {
        if (handle_) handle_.destroy();
    }

    // The outermost task: runs up to its first pause.
    void start() const { handle_.resume(); }
    [[nodiscard]] bool done() const { return handle_.done(); }
    [[nodiscard]] T result() const {
        if (handle_.promise().failure) std::rethrow_exception(handle_.promise().failure);
        return std::move(*handle_.promise().value);
    }

    // Inside another task: co_await task.
    [[nodiscard]] bool await_ready() const noexcept { return false; }
    [[nodiscard]] std::coroutine_handle<> await_suspend(std::coroutine_handle<> awaiting) const noexcept {
        handle_.promise().awaited_by = awaiting;
        return handle_;
    }
    [[nodiscard]] T await_resume() const { return result(); }

  private:
    explicit Task(Handle handle) : handle_(handle) {}

    Handle handle_;
};

}  // namespace peterka
