#include "eigentrail/scene/expression.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <iterator>
#include <map>
#include <optional>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/scene/limits.hpp"

namespace eigentrail {
namespace {

using Op = Expression::Op;

const std::map<std::string_view, Op>& functions() {
  static const std::map<std::string_view, Op> table = {
      {"sqrt", Op::sqrt}, {"sin", Op::sin},   {"cos", Op::cos},   {"tan", Op::tan},
      {"asin", Op::asin}, {"acos", Op::acos}, {"atan", Op::atan}, {"sinh", Op::sinh},
      {"cosh", Op::cosh}, {"tanh", Op::tanh}, {"exp", Op::exp},   {"log", Op::log}};
  return table;
}

bool starts_name(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
}
bool continues_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// Largest number of values on the stack during evaluation of postfix code.
int stack_depth(const std::vector<Expression::Instruction>& code) {
  int depth = 0;
  int most = 0;
  for (const Expression::Instruction& i : code) {
    const bool pushes = i.op == Op::number || i.op == Op::parameter;
    depth += pushes ? 1 : Expression::is_binary(i.op) ? -1 : 0;
    most = std::max(most, depth);
  }
  return most;
}

constexpr int max_depth = limits::expression_nesting;
constexpr std::size_t max_length = limits::expression_length;

}  // namespace

// Recursive descent parser for the grammar in the header, one function per rule; emits postfix code.
class ExpressionParser {
 public:
  ExpressionParser(std::string_view text, const std::vector<std::string>& names)
      : text_(text), names_(names) {
    result_.code_.clear();
  }

  Expression parse() {
    if (text_.size() > max_length)
      fail("expression longer than " + std::to_string(max_length) + " characters");
    sum();
    if (!at_end()) fail("unexpected '" + character() + "'");
    auto& used = result_.parameters_;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    return std::move(result_);
  }

 private:
  void sum() {
    if (++depth_ > max_depth) fail("parentheses nested deeper than " + std::to_string(max_depth));
    product();
    while (accept('+') || accept('-')) {
      const Op op = accepted() == '+' ? Op::add : Op::subtract;
      product();
      emit(op);
    }
    --depth_;
  }

  void product() {
    with_sign();
    while (accept('*') || accept('/')) {
      const Op op = accepted() == '*' ? Op::multiply : Op::divide;
      if (op == Op::multiply && accept('*')) {
        at_ -= 2;
        fail("powers are written with '^', as in x^2, not with '**'");
      }
      with_sign();
      emit(op);
    }
  }

  void with_sign() {
    bool negative = false;
    while (accept('-') || accept('+')) negative = negative != (accepted() == '-');
    power();
    if (negative) emit(Op::negate);
  }

  void power() {
    primary();
    if (!accept('^')) return;
    if (++depth_ > max_depth) fail("powers nested deeper than " + std::to_string(max_depth));
    const std::size_t exponent_begin = result_.code_.size();
    with_sign();
    --depth_;
    if (const auto n = whole_number(exponent_begin)) {
      result_.code_.resize(exponent_begin);
      --stack_;
      result_.code_.push_back({Op::integer_power, static_cast<double>(*n)});
    } else {
      emit(Op::power);
    }
  }

  /// The exponent if it is an integer literal with magnitude at most 64, so that 0^2 and (-1)^3 are defined.
  std::optional<int> whole_number(std::size_t begin) const {
    const auto& code = result_.code_;
    const std::size_t length = code.size() - begin;
    if (code[begin].op != Op::number || length > 2) return std::nullopt;
    if (length == 2 && code[begin + 1].op != Op::negate) return std::nullopt;
    const double value = length == 2 ? -code[begin].number : code[begin].number;
    if (value != std::floor(value) || std::abs(value) > 64.0) return std::nullopt;
    return static_cast<int>(value);
  }

  void primary() {
    skip_space();
    if (at_ >= text_.size()) fail("expression ends where a number, a parameter or '(' was expected");
    const char c = text_[at_];
    if (c == '(') {
      parenthesis();
    } else if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') {
      number();
    } else if (starts_name(c)) {
      name();
    } else {
      fail("unexpected '" + character() + "' where a number, a parameter or '(' was expected");
    }
  }

  void parenthesis() {
    const std::size_t opened = at_++;
    sum();
    if (accept(')')) return;
    if (!at_end()) fail("unexpected '" + character() + "' where ')' was expected");
    throw ExpressionError("this '(' is never closed", opened);
  }

  /// The character at the current position, with all its bytes if it is not ASCII.
  std::string character() const {
    std::size_t end = at_ + 1;
    while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xc0U) == 0x80U) ++end;
    return std::string(text_.substr(at_, end - at_));
  }

  void number() {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc()) fail("this is no number");
    at_ = static_cast<std::size_t>(end - text_.data());
    push({Op::number, value});
  }

  void name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && continues_name(text_[at_])) ++at_;
    const std::string_view name = text_.substr(begin, at_ - begin);
    skip_space();
    if (at_ < text_.size() && text_[at_] == '(') {
      call(name, begin);
    } else if (const auto found = std::find(names_.begin(), names_.end(), name); found != names_.end()) {
      const int index = static_cast<int>(found - names_.begin());
      result_.parameters_.push_back(index);
      push({Op::parameter, 0.0, index});
    } else if (name == "pi") {
      push({Op::number, std::numbers::pi});
    } else {
      throw ExpressionError("unknown parameter '" + std::string(name) + "'; " + suggestion(name, names_),
                            begin);
    }
  }

  void call(std::string_view name, std::size_t begin) {
    const auto function = functions().find(name);
    if (function == functions().end()) {
      std::vector<std::string> known;
      for (const auto& [text, op] : functions()) known.emplace_back(text);
      throw ExpressionError("unknown function '" + std::string(name) + "'; " + suggestion(name, known),
                            begin);
    }
    parenthesis();
    emit(function->second);
  }

  void push(Expression::Instruction instruction) {
    if (++stack_ > Expression::max_stack) fail("expression needs too many intermediate results");
    result_.code_.push_back(instruction);
  }

  void emit(Op op) {
    if (Expression::is_binary(op)) --stack_;
    result_.code_.push_back({op});
  }

  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool at_end() {
    skip_space();
    return at_ >= text_.size();
  }
  bool accept(char c) {
    skip_space();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  /// The character that was accepted last.
  char accepted() const { return text_[at_ - 1]; }
  [[noreturn]] void fail(const std::string& message) const { throw ExpressionError(message, at_); }

  std::string_view text_;
  const std::vector<std::string>& names_;
  std::size_t at_ = 0;
  int depth_ = 0;
  int stack_ = 0;
  Expression result_;
};

Expression Expression::parse(std::string_view text, const std::vector<std::string>& names) {
  return ExpressionParser(text, names).parse();
}

Expression Expression::folded() const {
  return is_constant() ? Expression(value()) : *this;
}

Expression Expression::compose(Op op, const Expression& a) {
  Expression result = a;
  result.code_.push_back({op});
  return result.folded();
}

Expression Expression::compose(Op op, const Expression& a, const Expression& b) {
  Expression result = a;
  result.code_.insert(result.code_.end(), b.code_.begin(), b.code_.end());
  result.code_.push_back({op});
  std::vector<int> both;
  std::set_union(a.parameters_.begin(), a.parameters_.end(), b.parameters_.begin(), b.parameters_.end(),
                 std::back_inserter(both));
  result.parameters_ = std::move(both);
  if (result.code_.size() > limits::expression_operations || stack_depth(result.code_) > max_stack) {
    throw ExpressionError(
        "a quantity made of this expression is too long or too deep to evaluate; give parts of it a name "
        "in [parameters]",
        0);
  }
  return result.folded();
}

}  // namespace eigentrail
