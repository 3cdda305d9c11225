/* A program of the mix that Weicker published as Dhrystone (CACM 27 (1984) 1013, version 2 in SIGPLAN Notices 23 (1988) 49): the
   procedures, calls, branches, loops, strings and records of his description, written anew. `dhrystone_turns` is what is timed. Its
   ground rules: no procedure within another, and calls across files, which noinline and noclone stand for. */
#include <stddef.h>
#include <string.h>

#define APART __attribute__((noinline, noclone))

enum Ident { ident_1, ident_2, ident_3, ident_4, ident_5 };
struct Record {
    struct Record *next;
    enum Ident discriminant;
    enum Ident kind;
    int number;
    char text[31];
};
typedef int Vector[50];
typedef int Matrix[50][50];

static struct Record first_record, second_record;
static struct Record *head, *tail;
static int shared_number;
static int shared_truth;
static char shared_letter_1, shared_letter_2;
static Vector vector;
static Matrix matrix;

/* Func_1: whether two letters differ, by a detour over locals. */
APART enum Ident compare_letters(char a, char b) {
    const char first = a;
    const char second = first;
    if (second != b) {
        return ident_1;
    }
    shared_letter_1 = first;
    return ident_2;
}
/* Func_2: strings of 30 letters. */
APART int compare_texts(const char *a, const char *b) {
    int at = 2;
    char letter = 'A';
    while (at <= 2) {
        if (compare_letters(a[at], b[at + 1]) == ident_1) {
            letter = 'A';
            ++at;
        }
    }
    if (letter >= 'W' && letter < 'Z') {
        at = 7;
    }
    if (letter == 'R') {
        return 1;
    }
    if (strcmp(a, b) > 0) {
        at += 7;
        shared_number = at;
        return 1;
    }
    return 0;
}
/* Func_3 */
APART int is_third(enum Ident ident) {
    const enum Ident copy = ident;
    return copy == ident_3;
}
/* Proc_7 */
APART void add_with_two(int a, int b, int *sum) {
    const int local = a + 2;
    *sum = b + local;
}
/* Proc_6: an enumeration by another. */
APART void choose_ident(enum Ident ident, enum Ident *chosen) {
    *chosen = ident;
    if (!is_third(ident)) {
        *chosen = ident_4;
    }
    switch (ident) {
        case ident_1: *chosen = ident_1; break;
        case ident_2: *chosen = shared_number > 100 ? ident_1 : ident_4; break;
        case ident_3: *chosen = ident_2; break;
        case ident_4: break;
        case ident_5: *chosen = ident_3; break;
    }
}
/* Proc_3 */
APART void follow_head(struct Record **to) {
    if (head != NULL) {
        *to = head->next;
    }
    add_with_two(10, shared_number, &head->number);
}
/* Proc_1 */
APART void work_on_record(struct Record *record) {
    struct Record *const next = record->next;
    *record->next = *head;
    record->number = 5;
    next->number = record->number;
    next->next = record->next;
    follow_head(&next->next);
    if (next->discriminant == ident_1) {
        next->number = 6;
        choose_ident(record->kind, &next->kind);
        next->next = head->next;
        add_with_two(next->number, 10, &next->number);
    } else {
        *record = *record->next;
    }
}
/* Proc_2 */
APART void count_down(int *number) {
    int local = *number + 10;
    enum Ident ident = ident_3;
    do {
        if (shared_letter_1 == 'A') {
            --local;
            *number = local - shared_number;
            ident = ident_1;
        }
    } while (ident != ident_1);
}
/* Proc_4 */
APART void set_truth(void) {
    const int is_a = shared_letter_1 == 'A';
    shared_truth = is_a | shared_truth;
    shared_letter_2 = 'B';
}
/* Proc_5 */
APART void set_letter(void) {
    shared_letter_1 = 'A';
    shared_truth = 0;
}
/* Proc_8 */
APART void work_on_arrays(int *row, Matrix table, int a, int b) {
    const int at = a + 5;
    row[at] = b;
    row[at + 1] = row[at];
    row[at + 30] = at;
    for (int i = at; i <= at + 1; ++i) {
        table[at][i] = at;
    }
    table[at][at - 1] += 1;
    table[at + 20][at] = row[at];
    shared_number = 5;
}

APART int dhrystone_turns(int turns) {
    char text_1[31];
    char text_2[31];
    int a = 0;
    int b = 0;
    int c = 0;
    strcpy(text_1, "DHRYSTONE-LIKE MIX, 1'ST TEXT.");
    for (int turn = 1; turn <= turns; ++turn) {
        enum Ident ident = ident_2;
        set_letter();
        set_truth();
        a = 2;
        b = 3;
        strcpy(text_2, "DHRYSTONE-LIKE MIX, 2'ND TEXT.");
        shared_truth = !compare_texts(text_1, text_2);
        while (a < b) {
            c = 5 * a - b;
            add_with_two(a, b, &c);
            ++a;
        }
        work_on_arrays(vector, matrix, a, c);
        work_on_record(head);
        for (char letter = 'A'; letter <= shared_letter_2; ++letter) {
            if (ident == compare_letters(letter, 'C')) {
                choose_ident(ident_1, &ident);
                strcpy(text_2, "DHRYSTONE-LIKE MIX, 3'RD TEXT.");
                b = turn;
                shared_number = turn;
            }
        }
        b = b * a;
        a = b / c;
        b = 7 * (b - c) - a;
        count_down(&a);
    }
    return a + b + c;
}

int dhrystone_main(int turns) {
    head = &first_record;
    tail = &second_record;
    head->next = tail;
    head->discriminant = ident_1;
    head->kind = ident_3;
    head->number = 40;
    strcpy(head->text, "DHRYSTONE-LIKE MIX, SOME TEXT.");
    matrix[8][7] = 10;
    return dhrystone_turns(turns);
}
